#include "tunica/drawing/picture_file.hpp"

#include <fmt/format.h>
#include <vtkAppendFilter.h>
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/field_io/field_file.hpp"
#include "tunica/mesh_io/vtk_check.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::drawing {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what, "give a complete file: write or copy it again");
}

void check_points_of_cells(vtkCellArray* cells, vtkIdType points, const fs::path& file) {
  if (!cells) return;
  if (!cells->IsValid()) refuse(file, "the offsets of the cells and their points do not belong together");
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(c, size, corners);
    for (vtkIdType i = 0; i < size; ++i)
      if (corners[i] < 0 || corners[i] >= points)
        refuse(file, fmt::format("a cell names point {}, but there are points 0 to {}", corners[i], points - 1));
  }
}

/// Points of a cell of this type; 0: any number.
vtkIdType size_of(int type, const fs::path& file) {
  if (type == VTK_POLY_VERTEX || type == VTK_POLY_LINE || type == VTK_TRIANGLE_STRIP || type == VTK_POLYGON) return 0;
  const bool linear = type >= VTK_VERTEX && type <= VTK_HEXAGONAL_PRISM,
             quadratic = type >= VTK_QUADRATIC_EDGE && type <= VTK_TRIQUADRATIC_HEXAHEDRON;
  vtkSmartPointer<vtkCell> cell;
  if (linear || quadratic) cell.TakeReference(vtkGenericCell::InstantiateCell(type));
  if (!cell) refuse(file, fmt::format("cells of type {} are not drawn", type));
  return cell->GetNumberOfPoints();
}

void check_cells(vtkUnstructuredGrid* grid, const fs::path& file) {
  check_points_of_cells(grid->GetCells(), grid->GetNumberOfPoints(), file);
  std::map<int, vtkIdType> sizes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const int type = grid->GetCellType(c);
    auto known = sizes.find(type);
    if (known == sizes.end()) known = sizes.emplace(type, size_of(type, file)).first;
    const vtkIdType size = grid->GetCells()->GetCellSize(c);
    if (known->second != 0 && size != known->second)
      refuse(file, fmt::format("a cell of type {} has {} points", type, size));
  }
}

void check_cells(vtkPolyData* surface, const fs::path& file) {
  for (auto* cells : {surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips()})
    check_points_of_cells(cells, surface->GetNumberOfPoints(), file);
}

template <class Reader>
auto read_piece(const fs::path& file, const char* kind) {
  vtkNew<Reader> reader;
  const mesh_io::FirstVtkMessage message(reader);
  const auto text = mesh_io::check_vtk_file(file, kind, std::nullopt);
  reader->SetFileName(file.c_str());
  reader->SetReadFromInputString(!text.empty());
  if (!text.empty()) reader->SetInputString(text);
  reader->Update();
  if (!message.text().empty()) refuse(file, "cannot be read: " + message.text());
  vtkSmartPointer output = reader->GetOutput();
  check_cells(output.Get(), file);
  return output;
}

/// One after the other, with the arrays that all have.
template <class Reader, class Append>
vtkPointSet* read_pieces(const fs::path& file, const char* kind) {
  vtkNew<Append> all;
  for (const auto& piece : mesh_io::read_vtk_pieces(file, kind).files)
    all->AddInputData(read_piece<Reader>(piece, kind));
  if (all->GetNumberOfInputConnections(0) == 0) refuse(file, "names no piece");
  all->Update();
  vtkPointSet* output = all->GetOutput();
  output->Register(nullptr);
  return output;
}

template <class Reader>
vtkPointSet* read_one(const fs::path& file, const char* kind) {
  const auto output = read_piece<Reader>(file, kind);
  output->Register(nullptr);
  return output;
}

/// Array `values` of so many tuples with a name.
vtkNew<vtkFloatArray> float_array(const field_io::ArrayHead& head, const std::vector<float>& values) {
  vtkNew<vtkFloatArray> array;
  array->SetName(head.name.c_str());
  array->SetNumberOfComponents(head.components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / head.components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

vtkNew<vtkUnstructuredGrid> grid_of(const field_io::RegionMesh& mesh) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetData(float_array({"", 3}, mesh.points));
  vtkNew<vtkCellArray> cells;
  const auto width = static_cast<std::size_t>(mesh.nodes_of_cell);
  for (std::size_t e = 0; e < mesh.elements(); ++e) {
    cells->InsertNextCell(mesh.nodes_of_cell);
    for (std::size_t a = 0; a < width; ++a) cells->InsertCellPoint(mesh.cells[e * width + a]);
  }
  grid->SetPoints(points);
  grid->SetCells(width == 10 ? VTK_QUADRATIC_TETRA : VTK_TETRA, cells);
  return grid;
}

vtkPointSet* read_results(const fs::path& path) {
  const field_io::FieldFile file(path);
  const auto grid = grid_of(file.read_mesh());
  const auto add = [&](vtkDataSetAttributes* to, const field_io::ArrayHead& head, const std::vector<float>& values,
                       vtkIdType tuples) {
    if (static_cast<vtkIdType>(values.size()) != tuples * head.components)
      refuse(path, fmt::format("`{}` is not of the size of the mesh", head.name));
    to->AddArray(float_array(head, values));
  };
  for (const auto& head : file.point_arrays())
    add(grid->GetPointData(), head, file.read_points(head.name), grid->GetNumberOfPoints());
  for (const auto& head : file.cell_arrays())
    add(grid->GetCellData(), head, file.read_cells(head.name), grid->GetNumberOfCells());
  grid->Register(nullptr);
  return grid;
}

}  // namespace

vtkPointSet* read_points(const std::string& file) {
  const std::string kind = fs::path(file).extension().string();
  if (kind == field_io::file_ending) return read_results(file);
  if (kind == ".vtu") return read_one<vtkXMLUnstructuredGridReader>(file, "UnstructuredGrid");
  if (kind == ".vtp") return read_one<vtkXMLPolyDataReader>(file, "PolyData");
  if (kind == ".pvtu") return read_pieces<vtkXMLUnstructuredGridReader, vtkAppendFilter>(file, "UnstructuredGrid");
  if (kind == ".pvtp") return read_pieces<vtkXMLPolyDataReader, vtkAppendPolyData>(file, "PolyData");
  throw InputError(file, "is neither a file of results nor a VTK XML mesh",
                   "give .hdf.series, .hdf, .vtu, .pvtu, .vtp, .pvtp or .pvd files");
}

}  // namespace tunica::drawing
