#include "tunica/artifacts/prestress_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/mesh_io/vtk_writer.hpp"
#include "tunica/wall/output.hpp"
#include "tunica/wall/quadratic_element.hpp"

namespace tunica::artifacts {

namespace {

namespace fs = std::filesystem;

vtkNew<vtkDoubleArray> array(const char* name, int components, std::size_t cells) {
  vtkNew<vtkDoubleArray> result;
  result->SetName(name);
  result->SetNumberOfComponents(components);
  result->SetNumberOfTuples(static_cast<vtkIdType>(cells));
  return result;
}

void set_shape(vtkUnstructuredGrid* grid, const mesh::MeshData& data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : data.points) points->InsertNextPoint(x.x);
  grid->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdTypeArray> number;
  number->SetName("GlobalElementID");
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) {
    cells->InsertNextCell(data.edges.empty() ? 4 : 10);
    for (const auto node : data.tetrahedra[e]) cells->InsertCellPoint(node);
    if (!data.edges.empty())
      for (const auto node : data.edges[e]) cells->InsertCellPoint(node);
    number->InsertNextValue(static_cast<vtkIdType>(e) + 1);
  }
  grid->SetCells(data.edges.empty() ? VTK_TETRA : VTK_QUADRATIC_TETRA, cells);
  vtkNew<vtkIntArray> region;
  region->SetName("region");
  for (std::size_t r = 0; r < data.regions.size(); ++r)
    for (auto e = data.regions[r].first_element; e < data.regions[r].end_element; ++e)
      region->InsertNextValue(static_cast<int>(r) + 1);
  grid->GetCellData()->AddArray(number);
  grid->GetCellData()->AddArray(region);
}

std::string name_of_point(std::size_t q) { return fmt::format("{} {}", wall::prestress_array, q + 1); }

void add_array(vtkUnstructuredGrid* grid, const std::string& name, int components, std::span<const double> values) {
  const auto to = array(name.c_str(), components, values.size() / static_cast<std::size_t>(components));
  std::copy(values.begin(), values.end(), to->GetPointer(0));
  grid->GetCellData()->AddArray(to);
}

/// Adds the arrays of the points of quadratic elements, [element][point][component]; returns their mean.
std::vector<double> add_points(vtkUnstructuredGrid* grid, int components, std::span<const double> values) {
  constexpr std::size_t points = wall::quadratic::points;
  const auto n = static_cast<std::size_t>(components), cells = values.size() / (points * n);
  std::vector<double> mean(cells * n, 0.0), of_point(cells * n);
  for (std::size_t q = 0; q < points; ++q) {
    for (std::size_t k = 0; k < of_point.size(); ++k) {
      of_point[k] = values[(k / n * points + q) * n + k % n];
      mean[k] += of_point[k] / points;
    }
    add_array(grid, name_of_point(q), components, of_point);
  }
  return mean;
}

void add_invariants(vtkUnstructuredGrid* grid, std::span<const double> values) {
  constexpr double kPa = 1e3;
  const std::size_t cells = values.size() / wall::voigt_size;
  const auto equivalent = array("von Mises stress [kPa]", 1, cells),
             principal = array("first principal stress [kPa]", 1, cells);
  for (std::size_t e = 0; e < cells; ++e) {
    wall::Symmetric<double> S0;
    for (std::size_t k = 0; k < wall::voigt_size; ++k) S0[static_cast<int>(k)] = values[wall::voigt_size * e + k];
    equivalent->SetValue(static_cast<vtkIdType>(e), wall::von_mises(S0) / kPa);
    principal->SetValue(static_cast<vtkIdType>(e), wall::principal_stresses(S0)[0] / kPa);
  }
  grid->GetCellData()->AddArray(equivalent);
  grid->GetCellData()->AddArray(principal);
}

/// How far a corner may lie from that of the file: nodes of the interface take the place of the lumen's, which a mesh
/// of the wall alone does not know (mesh::join), and files may hold coordinates in single precision.
double allowed_distance(const std::vector<Vec3<double>>& points, const std::array<std::int64_t, 4>& corners,
                        double tolerance, double size) {
  double shortest = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b)
      shortest = std::min(
          shortest, norm(points[static_cast<std::size_t>(corners[a])] - points[static_cast<std::size_t>(corners[b])]));
  return std::max(tolerance * shortest, 4e-7 * size);
}

/// What a file has to be found anew for where it is of the other elements.
void check_elements(const fs::path& file, const mesh_io::VtkCells& cells, bool quadratic) {
  const bool found = std::find(cells.types.begin(), cells.types.end(), VTK_QUADRATIC_TETRA) != cells.types.end();
  if (found == quadratic) return;
  const auto name = [](bool q) { return q ? "quadratic" : "linear"; };
  throw InputError(
      file.string(),
      fmt::format("is the prestress of {} elements, the case has `elements: {}`", name(found), name(quadratic)),
      fmt::format("find it anew by `tunica prestress CASE --overwrite`, or set `elements: {}`", name(found)));
}

/// What is wrong with the file, empty when nothing is. `wall`: the wall elements of `data`.
std::string mismatch(const mesh_io::VtkCells& file, const mesh::MeshData& data, const std::vector<std::int64_t>& wall,
                     bool quadratic, double tolerance) {
  const auto cells = std::ssize(file.types);
  if (cells != std::ssize(wall)) return fmt::format("has {} elements, the wall has {}", cells, wall.size());
  if (std::ssize(file.global_element_ids) != cells) return "has no cell array GlobalElementID";
  double size = 0.0;
  for (const auto& x : data.points)
    for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(x[i]));
  std::vector<char> seen(wall.size(), 0);
  for (std::int64_t c = 0; c < cells; ++c) {
    const auto id = file.global_element_ids[static_cast<std::size_t>(c)];
    if (id < 1 || id > cells || seen[static_cast<std::size_t>(id - 1)]++)
      return fmt::format("names element {} in cell {}, twice or out of 1 to {}", id, c + 1, cells);
    const auto& corners = data.tetrahedra[static_cast<std::size_t>(wall[static_cast<std::size_t>(id - 1)])];
    const auto first = static_cast<std::size_t>(file.offsets[static_cast<std::size_t>(c)]);
    if (file.offsets[static_cast<std::size_t>(c) + 1] != static_cast<std::int64_t>(first + (quadratic ? 10 : 4)))
      return fmt::format("has a cell {} that is no {}tetrahedron", c + 1, quadratic ? "quadratic " : "");
    const double allowed = allowed_distance(data.points, corners, tolerance, size);
    for (std::size_t a = 0; a < 4; ++a) {
      const auto& x = file.points[static_cast<std::size_t>(file.connectivity[first + a])];
      const auto& X = data.points[static_cast<std::size_t>(corners[a])];
      if (!(norm(x - X) <= allowed))
        return fmt::format(
            "has corner {} of element {} at ({:.6g}, {:.6g}, {:.6g}) m, the wall at ({:.6g}, {:.6g}, "
            "{:.6g}) m",
            a + 1, id, x[0], x[1], x[2], X[0], X[1], X[2]);
    }
  }
  return {};
}

}  // namespace

void write_prestress(const fs::path& file, const mesh::MeshData& data, wall::PrestressKind kind,
                     std::span<const double> values) {
  const int n = wall::components(kind);
  vtkNew<vtkUnstructuredGrid> grid;
  set_shape(grid, data);
  std::vector<double> mean;
  if (!data.edges.empty()) {
    mean = add_points(grid, n, values);
    values = mean;
  }
  add_array(grid, wall::prestress_array, n, values);
  if (kind == wall::PrestressKind::stress) add_invariants(grid, values);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  mesh_io::write_vtk(*writer, file);
}

void read_prestress(const fs::path& file, mesh::MeshData& data, int points, double tolerance) {
  const bool quadratic = points > 1;
  mesh_io::VtkCells cells = mesh_io::read_vtk_volume(file, {wall::prestress_array});
  check_elements(file, cells, quadratic);
  std::vector<std::int64_t> wall;
  for (const auto& region : data.regions)
    for (auto e = region.first_element; e < region.end_element && region.kind == mesh::RegionKind::wall; ++e)
      wall.push_back(e);
  if (const std::string wrong = mismatch(cells, data, wall, quadratic, tolerance); !wrong.empty())
    throw InputError(file.string(), wrong, "find the prestress of this mesh by `tunica prestress`");
  if (quadratic) {
    std::vector<std::string> names;
    for (std::size_t q = 0; q < static_cast<std::size_t>(points); ++q) names.push_back(name_of_point(q));
    cells.fields = mesh_io::read_vtk_volume(file, names).fields;
  }
  const int components = cells.fields[0].components;
  for (const auto& found : cells.fields)
    if ((found.components != 6 && found.components != 9) || found.components != components)
      throw InputError(file.string(), fmt::format("`{}` has {} components", found.name, found.components),
                       "6 are a stress, 9 a deformation gradient");
  const auto n = static_cast<std::size_t>(components), of_element = n * static_cast<std::size_t>(points);
  mesh::ElementField field{wall::prestress_array, components * points, {}};
  field.values.assign(of_element * data.tetrahedra.size(), std::nan(""));
  for (std::size_t c = 0; c < wall.size(); ++c) {
    const auto e = static_cast<std::size_t>(wall[static_cast<std::size_t>(cells.global_element_ids[c] - 1)]);
    for (std::size_t k = 0; k < of_element; ++k) {
      const mesh::ElementField& found = cells.fields[k / n];
      const double value = found.values[n * c + k % n];
      if (!std::isfinite(value))
        throw InputError(file.string(), fmt::format("`{}` is not finite in cell {}", found.name, c + 1),
                         "find it anew by `tunica prestress`");
      field.values[of_element * e + k] = value;
    }
  }
  data.fields.push_back(std::move(field));
}

}  // namespace tunica::artifacts
