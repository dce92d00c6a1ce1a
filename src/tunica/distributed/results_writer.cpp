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
  std::vector<field_io::RegionIndex> index;  ///< rank 0

  Implementation(const DistributedMesh& m, const ResultsOptions& o) : mesh(m), options(o) {
    parallel::on_root(mesh.comm, [&] { prepare_directory(); });
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      layouts.emplace_back(mesh, mesh.regions[r]);
      const auto shape = layouts.back().mesh(mesh, mesh.regions[r], options.length_factor);
      parallel::on_root(mesh.comm, [&] { write_mesh(index[r], shape); });
    }
  }

  void prepare_directory() {
    check_region_names(mesh);
    files::make_folder(options.directory);
    std::vector<fs::path> names;
    for (const auto& region : mesh.regions) names.emplace_back(field_io::instant_file(region.name, largest_step));
    files::try_outputs(options.directory, names);
    for (const auto& region : mesh.regions) {
      index.push_back({.name = region.name,
                       .nodes = 0,
                       .elements = 0,
                       .nodes_of_cell = 4,
                       .points = {},
                       .cells = {},
                       .series = {}});
      if (!options.continue_from) continue;
      auto& series = index.back().series;
      series = field_io::read_series(series_path(region.name));
      // The margin is for times of a series, which have 12 digits.
      const double last = *options.continue_from + 1e-11 * std::abs(*options.continue_from);
      std::erase_if(series, [&](const field_io::SeriesEntry& e) { return e.time > last; });
    }
  }

  fs::path series_path(const std::string& region) const { return field_io::series_file(options.directory, region); }

  void write_mesh(field_io::RegionIndex& entry, const field_io::RegionMesh& shape) const {
    entry.nodes = shape.nodes();
    entry.elements = shape.elements();
    entry.nodes_of_cell = shape.nodes_of_cell;
    const fs::path file = options.directory / field_io::mesh_file(entry.name);
    const std::string bytes = field_io::mesh_bytes(shape);
    if (holds(file, bytes)) return;
    if (!entry.series.empty() && fs::exists(file))
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

  void write_instant(std::size_t r, std::int64_t step, const field_io::Instant& instant) {
    auto& entry = index[r];
    entry.points = heads(instant.points);
    entry.cells = heads(instant.cells);
    files::write_atomically(options.directory / field_io::instant_file(entry.name, step),
                            field_io::instant_bytes(instant, field_io::mesh_file(entry.name)));
  }

  // Only when all regions are written, so that their series stay equally long unless the very last renaming fails.
  void write_lists(std::int64_t step, double time) {
    for (auto& entry : index) {
      auto longer = entry.series;
      std::erase_if(longer, [&](const field_io::SeriesEntry& e) { return e.time >= time; });
      longer.push_back({time, field_io::instant_file(entry.name, step)});
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
  const auto on_root = [&](const auto& action) {
    parallel::on_root(self.mesh.comm, [&] {
      try {
        action();
      } catch (const SolverError& error) {
        throw SolverError(fmt::format("results of step {} (t = {:g} s): {}", step, time, error.what()));
      }
    });
  };
  for (std::size_t r = 0; r < self.layouts.size(); ++r) {
    const auto instant = self.gather(r, clean, nodal, cells);
    on_root([&] { self.write_instant(r, step, instant); });
  }
  on_root([&] { self.write_lists(step, clean); });
}

}  // namespace tunica::distributed
