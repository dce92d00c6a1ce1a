#include "tunica/distributed/results_writer.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "tunica/base/digits.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/region_layout.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::distributed {

namespace {

namespace fs = std::filesystem;

/// As names of files are tried with.
constexpr std::int64_t largest_step = 999999999;

bool in_region(const NodalArray& a, std::size_t region) {
  return a.region < 0 || a.region == static_cast<std::int32_t>(region);
}
bool in_region(const CellArray& a, std::size_t region) { return a.region == static_cast<std::int32_t>(region); }

std::vector<field_io::ArrayHead> heads(const std::vector<field_io::Array>& arrays) {
  std::vector<field_io::ArrayHead> result;
  for (const auto& a : arrays) result.push_back({a.name, a.components});
  return result;
}

/// Would the file be written as it is?
bool holds(const fs::path& file, const std::string& bytes) {
  std::ifstream in(file, std::ios::binary);
  return in && std::string{std::istreambuf_iterator<char>(in), {}} == bytes;
}

}  // namespace

void check_region_names(const DistributedMesh& mesh) {
  for (const auto& region : mesh.regions)
    if (region.name.empty() || region.name.find_first_of("/&<>\"") != std::string::npos)
      throw InputError("region \"" + region.name + "\"", "this name cannot be part of a file name",
                       "rename the region");
}

struct ResultsWriter::Implementation {
  const DistributedMesh& mesh;
  ResultsOptions options;
  std::vector<RegionLayout> layouts;
  std::vector<field_io::RegionIndex> index;  ///< series: on rank 0

  // Regions are dealt out to the ranks, which pack and write them at the same time.
  Implementation(const DistributedMesh& m, const ResultsOptions& o) : mesh(m), options(o) {
    parallel::on_root(mesh.comm, [&] { prepare_directory(); });
    std::vector<field_io::RegionMesh> shapes;
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      const auto& layout = layouts.emplace_back(mesh, mesh.regions[r], static_cast<int>(r) % parallel::size(mesh.comm));
      shapes.push_back(layout.mesh(mesh, mesh.regions[r], options.length_factor));
      index.push_back({.name = mesh.regions[r].name,
                       .nodes = static_cast<std::size_t>(layout.nodes()),
                       .elements = static_cast<std::size_t>(layout.elements()),
                       .nodes_of_cell = mesh.quadratic ? 10 : 4,
                       .series = {}});
    }
    const auto keeps = take_series();
    parallel::agree(mesh.comm, [&] {
      for (std::size_t r = 0; r < layouts.size(); ++r)
        if (layouts[r].is_here()) write_mesh(index[r].name, shapes[r], keeps[r] != 0);
    });
  }

  void prepare_directory() {
    check_region_names(mesh);
    files::make_folder(options.directory);
    std::vector<fs::path> names;
    for (const auto& region : mesh.regions) names.emplace_back(field_io::instant_file(region.name, largest_step));
    files::try_outputs(options.directory, names);
  }

  /// Reads what the run goes on with, on rank 0; for each region, on all ranks, whether there are earlier instants.
  std::vector<int> take_series() {
    std::vector<int> keeps(index.size(), 0);
    if (!options.continue_from) return keeps;
    parallel::on_root(mesh.comm, [&] {
      // The margin is for times of a series, which have 12 digits.
      const double last = *options.continue_from + 1e-11 * std::abs(*options.continue_from);
      for (std::size_t r = 0; r < index.size(); ++r) {
        auto& series = index[r].series;
        series = field_io::read_series(series_path(index[r].name));
        std::erase_if(series, [&](const field_io::SeriesEntry& e) { return e.time > last; });
        for (auto& entry : series) find_arrays(entry);
        keeps[r] = series.empty() ? 0 : 1;
      }
    });
    parallel::broadcast(mesh.comm, keeps);
    return keeps;
  }

  /// None of a file that is gone or damaged: who opens it is told so.
  void find_arrays(field_io::SeriesEntry& entry) const {
    try {
      const field_io::FieldFile file(options.directory / entry.file);
      entry.points = file.point_arrays();
      entry.cells = file.cell_arrays();
    } catch (const InputError&) {
      entry.points.clear();
    }
  }

  fs::path series_path(const std::string& region) const { return field_io::series_file(options.directory, region); }

  void write_mesh(const std::string& region, const field_io::RegionMesh& shape, bool keeps) const {
    const fs::path file = options.directory / field_io::mesh_file(region);
    const std::string bytes = field_io::mesh_bytes(shape);
    if (holds(file, bytes)) return;
    if (keeps && fs::exists(file))
      throw InputError(file.string(), "is not the mesh that the run goes on with, and earlier instants refer to it",
                       "put back the mesh and `output.units.length`, or begin anew with --overwrite");
    files::write_atomically(file, bytes);
  }

  field_io::Instant gather(std::size_t r, double time, std::span<const NodalArray> nodal,
                           std::span<const CellArray> cells) const {
    field_io::Instant instant;
    instant.time = time;
    for (const auto& a : nodal)
      if (in_region(a, r))
        instant.points.push_back({a.name, a.components, layouts[r].nodal(a.values, a.stride, a.components, a.factor)});
    for (const auto& a : cells)
      if (in_region(a, r))
        instant.cells.push_back({a.name, a.components, layouts[r].cellwise(a.values, a.components, a.factor)});
    return instant;
  }

  void write_instant(const std::string& region, std::int64_t step, const field_io::Instant& instant) const {
    files::write_atomically(options.directory / field_io::instant_file(region, step),
                            field_io::instant_bytes(instant, field_io::mesh_file(region)));
  }

  // Only when all regions are written, so that their series stay equally long unless the very last renaming fails.
  void write_lists(std::int64_t step, double time, const std::vector<field_io::Instant>& instants) {
    for (std::size_t r = 0; r < index.size(); ++r) {
      auto& entry = index[r];
      auto longer = entry.series;
      std::erase_if(longer, [&](const field_io::SeriesEntry& e) { return e.time >= time; });
      longer.push_back(
          {time, field_io::instant_file(entry.name, step), heads(instants[r].points), heads(instants[r].cells)});
      files::write_atomically(series_path(entry.name), field_io::series_text(longer));
      entry.series = std::move(longer);
    }
    files::write_atomically(options.directory / field_io::overview_file, field_io::overview_text(index));
  }
};

ResultsWriter::ResultsWriter(const DistributedMesh& mesh, const ResultsOptions& options)
    : implementation_(std::make_unique<Implementation>(mesh, options)) {}
ResultsWriter::~ResultsWriter() = default;
ResultsWriter::ResultsWriter(ResultsWriter&&) noexcept = default;
ResultsWriter& ResultsWriter::operator=(ResultsWriter&&) noexcept = default;

void ResultsWriter::write(std::int64_t step, double time, std::span<const NodalArray> nodal,
                          std::span<const CellArray> cells) {
  auto& self = *implementation_;
  for ([[maybe_unused]] const auto& a : nodal)
    assert(a.name.find_first_of("/&<>\"") == std::string::npos && a.stride >= a.components &&
           (self.mesh.nodes() == 0 ||
            a.values.size() + static_cast<std::size_t>(a.stride - a.components) >=
                static_cast<std::size_t>(self.mesh.nodes()) * static_cast<std::size_t>(a.stride)));
  for ([[maybe_unused]] const auto& a : cells)
    assert(a.values.size() == static_cast<std::size_t>(self.mesh.regions[a.region].owned_elements) * a.components);
  const double clean = base::without_noise(time);
  std::vector<field_io::Instant> instants;
  for (std::size_t r = 0; r < self.layouts.size(); ++r) instants.push_back(self.gather(r, clean, nodal, cells));
  const auto together = [&](const auto& action) {
    parallel::agree(self.mesh.comm, [&] {
      try {
        action();
      } catch (const SolverError& error) {
        throw SolverError(fmt::format("results of step {} (t = {:g} s): {}", step, time, error.what()));
      }
    });
  };
  together([&] {
    for (std::size_t r = 0; r < instants.size(); ++r)
      if (self.layouts[r].is_here()) self.write_instant(self.index[r].name, step, instants[r]);
  });
  together([&] {
    if (parallel::rank(self.mesh.comm) == 0) self.write_lists(step, clean, instants);
  });
}

}  // namespace tunica::distributed
