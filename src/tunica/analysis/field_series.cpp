#include "tunica/analysis/field_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <unordered_map>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/field_io/array_name.hpp"
#include "tunica/field_io/series_index.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::analysis {

namespace {

namespace fs = std::filesystem;
namespace dimension = config::dimension;
using field_io::name_and_unit;
using mesh::RegionKind;

constexpr const char* run_again = "run the case again, with fields written (`output.every`)";

std::array<std::int64_t, 4> sorted(std::array<std::int64_t, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// For messages.
std::string printable_names(const std::vector<field_io::ArrayHead>& arrays) {
  std::string names;
  for (const auto& array : arrays)
    names += (names.empty() ? "" : ", ") + text::printable(name_and_unit(array.name).first);
  return names.empty() ? "none" : names;
}

}  // namespace

struct FieldSeries::Implementation {
  using Place = std::array<float, 3>;
  struct PlaceHash {
    std::size_t operator()(const Place& p) const {
      std::size_t h = 0;
      for (const float x : p) {
        std::uint32_t bits;
        const float clean = x + 0.0F;  // -0 and 0 are one place
        std::memcpy(&bits, &clean, sizeof bits);
        h = (h ^ bits) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 29;
      }
      return h;
    }
  };

  /// Points of the files by the nodes of a region, and their cells by the elements.
  struct Numbering {
    std::vector<std::int64_t> nodes, elements;  ///< of MeshData, by point, and by cell and its part
    std::size_t parts = 1;  ///< elements of MeshData in a cell: 8 where a quadratic one is subdivided
  };

  const RunDescription description;
  const mesh::MeshData& data;
  fs::path folder;
  std::vector<double> times;
  std::vector<std::string> stresses;
  std::vector<std::vector<std::string>> files;  ///< [region][frame]
  std::vector<Numbering> numbering;             ///< [region]; all instants have the same mesh

  Implementation(RunDescription r, const mesh::MeshData& d, fs::path f)
      : description(std::move(r)), data(d), folder(std::move(f)), numbering(d.regions.size()) {
    find_frames();
    for (std::size_t k = 0; k < data.regions.size(); ++k) {
      const field_io::FieldFile first = open(k, 0);
      find_stresses(first, k);
      number(first.read_mesh(), k);
    }
  }

  void find_frames() {
    std::vector<std::vector<field_io::SeriesEntry>> series;
    for (const auto& region : data.regions) {
      series.push_back(field_io::read_series(field_io::series_file(folder, region.name)));
      if (series.back().empty())
        throw InputError(folder.string(), fmt::format("holds no results of the region {}", region.name),
                         "run the case first (tunica run), or name the folder of its fields");
    }
    for (const auto& entry : series[0]) {
      std::vector<std::string> names;
      for (const auto& region : series)
        for (const auto& other : region)
          if (other.time == entry.time) names.push_back(other.file);
      if (names.size() != series.size()) continue;  // a run that died may have written some regions only
      times.push_back(entry.time);
      files.resize(series.size());
      for (std::size_t r = 0; r < series.size(); ++r) files[r].push_back(names[r]);
    }
    if (times.empty()) throw InputError(folder.string(), "has no time that all regions have in common", run_again);
  }

  void find_stresses(const field_io::FieldFile& file, std::size_t region) {
    if (data.regions[region].kind != RegionKind::wall) return;
    for (const auto& array : file.cell_arrays()) {
      const auto name = name_and_unit(array.name).first;
      if (array.components == 1 && name.find("stress") != std::string::npos &&
          std::find(stresses.begin(), stresses.end(), name) == stresses.end())
        stresses.push_back(name);
    }
  }

  fs::path path(std::size_t region, std::size_t frame) const { return folder / files[region][frame]; }

  field_io::FieldFile open(std::size_t region, std::size_t frame) const {
    const fs::path file = path(region, frame);
    if (!fs::exists(file)) throw InputError(file.string(), "is missing, though the series names it", run_again);
    return field_io::FieldFile(file);
  }

  void read_region(std::size_t region, std::size_t frame, FieldFrame& into) {
    const auto file = open(region, frame);
    take_nodal(file, region, frame, into);
    take_stresses(file, region, frame, into);
  }

  void number(const field_io::RegionMesh& mesh, std::size_t region) {
    const fs::path file = path(region, 0);
    Numbering& n = numbering[region];
    number_points(n, mesh, region, file);
    std::vector<std::int64_t> cells;
    const auto width = static_cast<std::size_t>(mesh.nodes_of_cell);
    constexpr int whole[1][4] = {{0, 1, 2, 3}};
    const bool quadratic = width == 10, same = !data.edges.empty();
    if (same && !quadratic) refuse(file, "has linear elements, the mesh has quadratic ones");
    const auto parts =
        quadratic && !same ? std::span<const int[4]>(mesh::parts_of_tetrahedron) : std::span<const int[4]>(whole);
    n.parts = parts.size();
    for (std::size_t e = 0; e < mesh.elements(); ++e)
      for (const auto& part : parts)
        for (const int a : part) cells.push_back(mesh.cells[e * width + static_cast<std::size_t>(a)]);
    number_cells(n, cells, region, file);
  }

  [[noreturn]] static void refuse(const fs::path& file, const std::string& what) {
    throw InputError(file.string(), what,
                     "the results belong to another mesh, or `output.units.length` has changed since: run the case "
                     "again, or put back the case that made them");
  }

  void number_points(Numbering& n, const field_io::RegionMesh& mesh, std::size_t region, const fs::path& file) const {
    // The same arithmetic as in the writer of the results, so that the floats agree.
    const double factor = 1 / config::unit_factor(description.length_unit, dimension::length);
    std::unordered_map<Place, std::int64_t, PlaceHash> known;
    const auto& r = data.regions[region];
    const auto know = [&](std::int64_t node) {
      const auto x = factor * data.points[static_cast<std::size_t>(node)];
      known.emplace(Place{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}, node);
    };
    for (auto e = static_cast<std::size_t>(r.first_element); e < static_cast<std::size_t>(r.end_element); ++e) {
      std::for_each(data.tetrahedra[e].begin(), data.tetrahedra[e].end(), know);
      if (!data.edges.empty()) std::for_each(data.edges[e].begin(), data.edges[e].end(), know);
    }
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
      const Place place{mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
      const auto found = known.find(place);
      if (found == known.end())
        refuse(file, fmt::format("has a point ({}, {}, {}) where the mesh has none", place[0], place[1], place[2]));
      n.nodes.push_back(found->second);
    }
  }

  void number_cells(Numbering& n, const std::vector<std::int64_t>& cells, std::size_t region,
                    const fs::path& file) const {
    std::vector<std::pair<std::array<std::int64_t, 4>, std::int64_t>> known;
    const auto& r = data.regions[region];
    for (auto e = r.first_element; e < r.end_element; ++e)
      known.emplace_back(sorted(data.tetrahedra[static_cast<std::size_t>(e)]), e);
    std::sort(known.begin(), known.end());
    for (std::size_t i = 0; i < cells.size(); i += 4) {
      std::array<std::int64_t, 4> nodes;
      for (std::size_t a = 0; a < 4; ++a) nodes[a] = n.nodes[static_cast<std::size_t>(cells[i + a])];
      nodes = sorted(nodes);
      const auto found = std::lower_bound(known.begin(), known.end(), std::pair{nodes, std::int64_t{0}});
      if (found == known.end() || found->first != nodes) refuse(file, "has an element that the mesh does not have");
      n.elements.push_back(found->second);
    }
    if (n.elements.size() != known.size())
      refuse(file, fmt::format("has {} elements, the mesh has {}", n.elements.size(), known.size()));
  }

  /// Factor of the unit that a file gives an array.
  static double factor_of(const std::string& unit, const config::Dimension& due, const fs::path& file) {
    try {
      return config::unit_factor(unit, due);
    } catch (const InputError& error) {
      throw InputError(file.string(), format(error.problems().front()), run_again);
    }
  }

  /// One array by its name without unit, to the nodes of the region.
  void take(const field_io::FieldFile& file, std::size_t region, std::size_t frame, const std::string& name,
            const config::Dimension& due, std::size_t components, std::vector<double>& to) const {
    const auto& nodes = numbering[region].nodes;
    for (const auto& array : file.point_arrays()) {
      const auto [found, unit] = name_and_unit(array.name);
      if (found != name) continue;
      const double factor = factor_of(unit, due, path(region, frame));
      const auto values = file.read_points(array.name);
      if (values.size() != components * nodes.size())
        throw InputError(
            path(region, frame).string(),
            fmt::format("`{}` does not have {} components for each of {} points", name, components, nodes.size()),
            run_again);
      to.resize(components * data.points.size(), 0.0);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t c = 0; c < components; ++c)
          to[components * static_cast<std::size_t>(nodes[i]) + c] = factor * values[components * i + c];
      return;
    }
    throw InputError(path(region, frame).string(),
                     fmt::format("has no field `{}`, only: {}", name, printable_names(file.point_arrays())),
                     "run the case again, with it among `output.fields`, or without that key");
  }

  void take_nodal(const field_io::FieldFile& file, std::size_t region, std::size_t frame, FieldFrame& into) const {
    if (description.wall) take(file, region, frame, "displacement", dimension::length, 3, into.displacement);
    if (data.regions[region].kind != RegionKind::lumen) return;
    take(file, region, frame, "velocity", dimension::velocity, 3, into.velocity);
    take(file, region, frame, "pressure", dimension::pressure, 1, into.pressure);
    take(file, region, frame, "wall shear stress", dimension::pressure, 3, into.wall_shear);
  }

  void take_stresses(const field_io::FieldFile& file, std::size_t region, std::size_t frame, FieldFrame& into) const {
    const Numbering& n = numbering[region];
    for (const auto& array : file.cell_arrays()) {
      const auto [name, unit] = name_and_unit(array.name);
      const auto found = std::find(stresses.begin(), stresses.end(), name);
      if (found == stresses.end()) continue;
      const double factor = factor_of(unit, dimension::pressure, path(region, frame));
      const auto values = file.read_cells(array.name);
      if (values.size() * n.parts != n.elements.size())
        throw InputError(path(region, frame).string(), fmt::format("`{}` does not have one value for each cell", name),
                         run_again);
      auto& to = into.stress[static_cast<std::size_t>(found - stresses.begin())];
      for (std::size_t e = 0; e < n.elements.size(); ++e)
        to[static_cast<std::size_t>(n.elements[e])] = factor * values[e / n.parts];
    }
  }
};

FieldSeries::FieldSeries(const RunDescription& run, const mesh::MeshData& data, fs::path folder)
    : implementation_(std::make_unique<Implementation>(run, data, std::move(folder))) {}
FieldSeries::~FieldSeries() = default;
FieldSeries::FieldSeries(FieldSeries&&) noexcept = default;
FieldSeries& FieldSeries::operator=(FieldSeries&&) noexcept = default;

const std::vector<double>& FieldSeries::times() const { return implementation_->times; }
const std::vector<std::string>& FieldSeries::stresses() const { return implementation_->stresses; }

FieldFrame FieldSeries::read(std::size_t frame) {
  auto& self = *implementation_;
  FieldFrame f;
  f.time = self.times[frame];
  f.stress.assign(self.stresses.size(),
                  std::vector<double>(self.data.tetrahedra.size(), std::numeric_limits<double>::quiet_NaN()));
  for (std::size_t r = 0; r < self.data.regions.size(); ++r) self.read_region(r, frame, f);
  return f;
}

}  // namespace tunica::analysis
