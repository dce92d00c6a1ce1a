#include "tunica/analysis/field_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::analysis {

namespace {

namespace fs = std::filesystem;
namespace dimension = config::dimension;
using mesh::RegionKind;

constexpr int tetrahedron = 10, quadratic_tetrahedron = 24;  // VTK_TETRA, VTK_QUADRATIC_TETRA
constexpr const char* run_again = "run the case again, with fields written (`output.every`)";

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

std::array<std::int64_t, 4> sorted(std::array<std::int64_t, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// "name [unit]" in two.
std::pair<std::string, std::string> name_and_unit(const std::string& text) {
  const auto at = text.find(" [");
  if (at == std::string::npos || text.back() != ']') return {text, ""};
  return {text.substr(0, at), text.substr(at + 2, text.size() - at - 3)};
}

/// What reads a file for others says how to mend it as such; results are best computed again.
template <class Read>
auto as_results(const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    auto problems = error.problems();
    for (auto& problem : problems) problem.remedy = run_again;
    throw InputError(std::move(problems));
  }
}

mesh_io::VtkPieces head_of(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(file.string(), "is missing, though the series names it", run_again);
  return as_results([&] { return mesh_io::read_vtk_pieces(file); });
}

/// A region at one time: the pieces that ranks have written, in the order of the file that names them.
struct RegionFields {
  fs::path file;
  std::vector<std::string> point_arrays;   ///< all that there are
  std::vector<std::string> points, cells;  ///< those that have been read, as the fields of the pieces
  std::vector<mesh_io::VtkCells> pieces;
};

/// Points of a file by the nodes of a region, and its cells by the elements.
struct Numbering {
  std::vector<float> places;                  ///< that it was made for
  std::vector<std::int64_t> cells;            ///< the same for the connectivity
  std::vector<std::int64_t> nodes, elements;  ///< of MeshData, by point and cell
};

}  // namespace

struct FieldSeries::Implementation {
  const RunDescription description;
  const mesh::MeshData& data;
  fs::path folder;
  std::vector<double> times;
  std::vector<std::string> stresses;
  std::vector<std::vector<std::string>> files;  ///< [region][frame]
  std::vector<Numbering> numbering;             ///< [region]

  Implementation(RunDescription r, const mesh::MeshData& d, fs::path f)
      : description(std::move(r)), data(d), folder(std::move(f)), numbering(d.regions.size()) {
    find_frames();
    find_stresses();
  }

  void find_frames() {
    std::vector<std::vector<files::SeriesEntry>> series;
    for (const auto& region : data.regions) {
      series.push_back(files::read_pvd(folder / (region.name + ".pvd")));
      if (series.back().empty())
        throw InputError(folder.string(), fmt::format("holds no results of the region {}", region.name),
                         "run the case first: tunica run, or name the folder by --results");
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

  // The head of a file names the arrays.
  void find_stresses() {
    for (std::size_t r = 0; r < data.regions.size(); ++r) {
      if (data.regions[r].kind != RegionKind::wall) continue;
      for (const auto& array : head_of(path(r, 0)).cell_arrays) {
        const auto name = name_and_unit(array).first;
        if (name.find("stress") != std::string::npos &&
            std::find(stresses.begin(), stresses.end(), name) == stresses.end())
          stresses.push_back(name);
      }
    }
  }

  fs::path path(std::size_t region, std::size_t frame) const { return folder / files[region][frame]; }

  /// Is the array of points of a region of use? Of a wall the motion and the stresses are all that is wanted.
  bool is_wanted(const std::string& array, std::size_t region) const {
    const auto name = name_and_unit(array).first;
    if (name == "displacement") return description.wall;
    return data.regions[region].kind == RegionKind::lumen &&
           (name == "velocity" || name == "pressure" || name == "wall shear stress");
  }

  RegionFields read_pieces(std::size_t region, std::size_t frame) const {
    RegionFields r{path(region, frame), {}, {}, {}, {}};
    auto head = head_of(r.file);
    for (const auto& array : head.point_arrays)
      if (is_wanted(array, region)) r.points.push_back(array);
    for (const auto& array : head.cell_arrays)
      if (std::find(stresses.begin(), stresses.end(), name_and_unit(array).first) != stresses.end())
        r.cells.push_back(array);
    r.point_arrays = std::move(head.point_arrays);
    for (const auto& file : head.files)
      r.pieces.push_back(as_results([&] { return mesh_io::read_vtk_volume(file, r.cells, r.points); }));
    return r;
  }

  void read_region(std::size_t region, std::size_t frame, FieldFrame& into) {
    const auto fields = read_pieces(region, frame);
    number(fields, region);
    take_nodal(fields, region, into);
    take_stresses(fields, region, into);
  }

  void number(const RegionFields& fields, std::size_t region) {
    Numbering& n = numbering[region];
    std::vector<float> places;
    std::vector<std::int64_t> cells;
    for (const auto& piece : fields.pieces) {
      const auto first = std::ssize(places) / 3;
      for (const auto& x : piece.points)
        for (int c = 0; c < 3; ++c) places.push_back(static_cast<float>(x[c]));
      for (std::size_t e = 0; e < piece.types.size(); ++e)
        if (piece.types[e] == quadratic_tetrahedron && piece.offsets[e + 1] - piece.offsets[e] == 10) {
          for (const auto& part : mesh::parts_of_tetrahedron)
            for (const int a : part)
              cells.push_back(first + piece.connectivity[static_cast<std::size_t>(piece.offsets[e] + a)]);
        } else if (piece.types[e] == tetrahedron && piece.offsets[e + 1] - piece.offsets[e] == 4) {
          for (int a = 0; a < 4; ++a)
            cells.push_back(first + piece.connectivity[static_cast<std::size_t>(piece.offsets[e] + a)]);
        } else {
          throw InputError(fields.file.string(), "holds cells that are no tetrahedra", run_again);
        }
    }
    if (places == n.places && cells == n.cells) return;
    n = {};  // not kept where it turns out not to be of this mesh
    Numbering found{std::move(places), std::move(cells), {}, {}};
    number_points(found, region, fields.file);
    number_cells(found, region, fields.file);
    n = std::move(found);
  }

  [[noreturn]] static void refuse(const fs::path& file, const std::string& what) {
    throw InputError(file.string(), what,
                     "the results belong to another mesh, or `output.units.length` has changed since: run the case "
                     "again, or put back the case that made them");
  }

  void number_points(Numbering& n, std::size_t region, const fs::path& file) const {
    // The same arithmetic as in the writer of the results, so that the floats agree.
    const double factor = 1 / config::unit_factor(description.length_unit, dimension::length);
    std::unordered_map<Place, std::int64_t, PlaceHash> known;
    const auto& r = data.regions[region];
    for (auto e = r.first_element; e < r.end_element; ++e)
      for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)]) {
        const auto x = factor * data.points[static_cast<std::size_t>(node)];
        known.emplace(Place{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}, node);
      }
    for (std::size_t i = 0; i < n.places.size(); i += 3) {
      const auto found = known.find({n.places[i], n.places[i + 1], n.places[i + 2]});
      if (found == known.end())
        refuse(file, fmt::format("has a point ({}, {}, {}) where the mesh has none", n.places[i], n.places[i + 1],
                                 n.places[i + 2]));
      n.nodes.push_back(found->second);
    }
  }

  void number_cells(Numbering& n, std::size_t region, const fs::path& file) const {
    std::vector<std::pair<std::array<std::int64_t, 4>, std::int64_t>> known;
    const auto& r = data.regions[region];
    for (auto e = r.first_element; e < r.end_element; ++e)
      known.emplace_back(sorted(data.tetrahedra[static_cast<std::size_t>(e)]), e);
    std::sort(known.begin(), known.end());
    for (std::size_t i = 0; i < n.cells.size(); i += 4) {
      std::array<std::int64_t, 4> nodes;
      for (std::size_t a = 0; a < 4; ++a) nodes[a] = n.nodes[static_cast<std::size_t>(n.cells[i + a])];
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
  void take(const RegionFields& fields, std::size_t region, const std::string& name, const config::Dimension& due,
            std::size_t components, std::vector<double>& to) const {
    for (std::size_t k = 0; k < fields.points.size(); ++k) {
      const auto [found, unit] = name_and_unit(fields.points[k]);
      if (found != name) continue;
      const double factor = factor_of(unit, due, fields.file);
      to.resize(components * data.points.size(), 0.0);
      auto node = numbering[region].nodes.begin();
      for (const auto& piece : fields.pieces) {
        const auto& field = piece.point_fields[k];
        if (field.values.size() != components * piece.points.size())
          throw InputError(fields.file.string(), fmt::format("`{}` does not have {} components", name, components),
                           run_again);
        for (std::size_t i = 0; i < piece.points.size(); ++i, ++node)
          for (std::size_t c = 0; c < components; ++c)
            to[components * static_cast<std::size_t>(*node) + c] = factor * field.values[components * i + c];
      }
      return;
    }
    std::string names;
    for (const auto& array : fields.point_arrays)
      names += (names.empty() ? "" : ", ") + text::printable(name_and_unit(array).first);
    throw InputError(fields.file.string(), fmt::format("has no field `{}`, only: {}", name, names), run_again);
  }

  void take_nodal(const RegionFields& fields, std::size_t region, FieldFrame& into) const {
    if (description.wall) take(fields, region, "displacement", dimension::length, 3, into.displacement);
    if (data.regions[region].kind != RegionKind::lumen) return;
    take(fields, region, "velocity", dimension::velocity, 3, into.velocity);
    take(fields, region, "pressure", dimension::pressure, 1, into.pressure);
    take(fields, region, "wall shear stress", dimension::pressure, 3, into.wall_shear);
  }

  void take_stresses(const RegionFields& fields, std::size_t region, FieldFrame& into) const {
    for (std::size_t k = 0; k < fields.cells.size(); ++k) {
      const auto [name, unit] = name_and_unit(fields.cells[k]);
      const double factor = factor_of(unit, dimension::pressure, fields.file);
      const auto found = std::find(stresses.begin(), stresses.end(), name);
      auto& to = into.stress[static_cast<std::size_t>(found - stresses.begin())];
      auto element = numbering[region].elements.begin();
      for (const auto& piece : fields.pieces) {
        const auto& field = piece.fields[k];
        if (field.values.size() != piece.types.size())
          throw InputError(fields.file.string(), fmt::format("`{}` does not have one component", name), run_again);
        for (std::size_t e = 0; e < field.values.size(); ++e)
          for (int part = 0; part < (piece.types[e] == quadratic_tetrahedron ? 8 : 1); ++part)
            to[static_cast<std::size_t>(*element++)] = factor * field.values[e];
      }
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
