#include "tunica/analysis/field_series.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/files/series_file.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::analysis {

namespace {

namespace fs = std::filesystem;
namespace dimension = config::dimension;
using mesh::RegionKind;

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

/// Points of a file by the nodes of a region, and its cells by the elements.
struct Numbering {
  std::vector<float> places;                  ///< that it was made for
  std::vector<vtkIdType> cells;               ///< the same for the connectivity
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
      vtkNew<vtkXMLPUnstructuredGridReader> reader;
      open(reader, r, 0);
      auto* arrays = reader->GetCellDataArraySelection();
      for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
        const auto name = name_and_unit(arrays->GetArrayName(k)).first;
        if (name.find("stress") != std::string::npos &&
            std::find(stresses.begin(), stresses.end(), name) == stresses.end())
          stresses.push_back(name);
      }
    }
  }

  fs::path path(std::size_t region, std::size_t frame) const { return folder / files[region][frame]; }

  void open(vtkXMLPUnstructuredGridReader* reader, std::size_t region, std::size_t frame) const {
    const auto file = path(region, frame);
    if (!fs::exists(file)) throw InputError(file.string(), "is missing, though the series names it", run_again);
    const mesh_io::FirstVtkMessage message(reader);
    reader->SetFileName(file.c_str());
    reader->UpdateInformation();
    if (!message.text().empty()) throw InputError(file.string(), "cannot be read: " + message.text(), run_again);
  }

  void read_region(std::size_t region, std::size_t frame, FieldFrame& into) {
    vtkNew<vtkXMLPUnstructuredGridReader> reader;
    open(reader, region, frame);
    const mesh_io::FirstVtkMessage message(reader);
    if (data.regions[region].kind == RegionKind::wall)  // the motion and the stresses are all that is wanted
      reader->GetPointDataArraySelection()->DisableAllArrays();
    auto* points = reader->GetPointDataArraySelection();
    for (int k = 0; k < points->GetNumberOfArrays(); ++k)
      if (name_and_unit(points->GetArrayName(k)).first == "displacement") points->EnableArray(points->GetArrayName(k));
    reader->Update();
    const auto file = path(region, frame);
    if (!message.text().empty()) throw InputError(file.string(), "cannot be read: " + message.text(), run_again);
    vtkUnstructuredGrid* grid = reader->GetOutput();
    number(grid, region, file);
    take_nodal(grid, region, file, into);
    take_stresses(grid, region, into);
  }

  void number(vtkUnstructuredGrid* grid, std::size_t region, const fs::path& file) {
    Numbering& n = numbering[region];
    std::vector<float> places(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
      double x[3];
      grid->GetPoint(i, x);
      for (int c = 0; c < 3; ++c) places[3 * static_cast<std::size_t>(i) + c] = static_cast<float>(x[c]);
    }
    std::vector<vtkIdType> cells;
    for (vtkIdType e = 0; e < grid->GetNumberOfCells(); ++e) {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      grid->GetCellPoints(e, count, corners);
      if (count != 4) throw InputError(file.string(), "holds cells that are no tetrahedra", run_again);
      cells.insert(cells.end(), corners, corners + 4);
    }
    if (places == n.places && cells == n.cells) return;
    n = {std::move(places), std::move(cells), {}, {}};
    number_points(n, region, file);
    number_cells(n, region, file);
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

  /// One array by its name without unit, to the nodes of the region.
  void take(vtkUnstructuredGrid* grid, std::size_t region, const fs::path& file, const std::string& name,
            const config::Dimension& due, int components, std::vector<double>& to) const {
    auto* arrays = grid->GetPointData();
    std::string names;
    for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
      const auto [found, unit] = name_and_unit(arrays->GetArrayName(k));
      names += (names.empty() ? "" : ", ") + found;
      vtkDataArray* array = arrays->GetArray(k);
      if (found != name || array == nullptr || array->GetNumberOfComponents() != components) continue;
      const double factor = config::unit_factor(unit, due);
      const auto width = static_cast<std::size_t>(components);
      to.resize(width * data.points.size(), 0.0);
      for (std::size_t i = 0; i < numbering[region].nodes.size(); ++i)
        for (std::size_t c = 0; c < width; ++c)
          to[width * static_cast<std::size_t>(numbering[region].nodes[i]) + c] =
              factor * array->GetComponent(static_cast<vtkIdType>(i), static_cast<int>(c));
      return;
    }
    throw InputError(file.string(), fmt::format("has no field `{}`, only: {}", name, names), run_again);
  }

  void take_nodal(vtkUnstructuredGrid* grid, std::size_t region, const fs::path& file, FieldFrame& into) const {
    if (description.wall) take(grid, region, file, "displacement", dimension::length, 3, into.displacement);
    if (data.regions[region].kind != RegionKind::lumen) return;
    take(grid, region, file, "velocity", dimension::velocity, 3, into.velocity);
    take(grid, region, file, "pressure", dimension::pressure, 1, into.pressure);
    take(grid, region, file, "wall shear stress", dimension::pressure, 3, into.wall_shear);
  }

  void take_stresses(vtkUnstructuredGrid* grid, std::size_t region, FieldFrame& into) const {
    auto* arrays = grid->GetCellData();
    for (int k = 0; k < arrays->GetNumberOfArrays(); ++k) {
      const auto [name, unit] = name_and_unit(arrays->GetArrayName(k));
      const auto found = std::find(stresses.begin(), stresses.end(), name);
      if (found == stresses.end()) continue;
      const double factor = config::unit_factor(unit, dimension::pressure);
      auto& to = into.stress[static_cast<std::size_t>(found - stresses.begin())];
      for (std::size_t e = 0; e < numbering[region].elements.size(); ++e)
        to[static_cast<std::size_t>(numbering[region].elements[e])] =
            factor * arrays->GetArray(k)->GetComponent(static_cast<vtkIdType>(e), 0);
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
