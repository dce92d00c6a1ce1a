#include "tunica/mesh_io/vtk_files.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_check.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::mesh_io {

namespace {

constexpr const char* node_ids = "GlobalNodeID";
constexpr const char* element_ids = "GlobalElementID";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string(), what, "give a readable VTK XML file, or export the mesh again");
}

/// What is not wanted is not read, and cannot be damaged.
void select(vtkDataArraySelection* selection, const std::vector<std::string>& wanted) {
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i) {
    const std::string name = selection->GetArrayName(i);
    const bool want = std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    selection->SetArraySetting(name.c_str(), want ? 1 : 0);
  }
}

/// Runs the reader and returns its output, or throws with VTK's own message.
template <class Reader>
void update(Reader* reader, const char* kind, const std::vector<std::string>& fields,
            const std::filesystem::path& path) {
  auto wanted = fields;
  wanted.insert(wanted.end(), {node_ids, element_ids});
  const FirstVtkMessage message(reader);
  const auto text = check_vtk_file(path, kind, wanted);
  try {
    reader->SetFileName(path.c_str());
    reader->SetReadFromInputString(!text.empty());
    if (!text.empty()) reader->SetInputString(text);
    reader->UpdateInformation();
    select(reader->GetPointDataArraySelection(), wanted);
    select(reader->GetCellDataArraySelection(), wanted);
    reader->Update();
  } catch (const std::bad_alloc&) {
    refuse(path, "holds more data than fit into the memory of this machine");
  }
  if (!message.text().empty()) refuse(path, "cannot be read: " + message.text());
  if (reader->GetErrorCode() != 0) refuse(path, fmt::format("cannot be read: VTK's error {}", reader->GetErrorCode()));
}

std::vector<std::int64_t> integers(vtkDataSetAttributes* attributes, const char* name, std::int64_t expected,
                                   const std::filesystem::path& path) {
  std::vector<std::int64_t> values;
  vtkDataArray* array = attributes->GetArray(name);
  if (!array) return values;
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != expected)
    refuse(path, fmt::format("{} has {} values, {} expected", name, array->GetNumberOfTuples(), expected));
  values.resize(expected);
  // Beyond this a floating-point number has no units, and no mesh has such numbers.
  constexpr double largest = 9e15;
  for (std::int64_t i = 0; i < expected; ++i) {
    const double value = array->GetComponent(i, 0);
    values[i] = std::abs(value) < largest ? static_cast<std::int64_t>(value) : -1;
  }
  return values;
}

/// `kind`: "cell" or "point".
mesh::ElementField field_of(vtkDataSetAttributes* attributes, vtkDataArraySelection* present, const char* kind,
                            const std::string& name, const std::filesystem::path& path) {
  vtkDataArray* array = attributes->GetArray(name.c_str());
  if (!array) {
    std::string names;
    for (int i = 0; i < present->GetNumberOfArrays(); ++i)
      names += (names.empty() ? "" : ", ") + std::string(present->GetArrayName(i));
    throw InputError(
        path.string(), fmt::format("there is no numeric {} array called {}", kind, name),
        names.empty() ? fmt::format("write one to the file, it has no {} arrays", kind) : "use one of: " + names);
  }
  mesh::ElementField field{name, array->GetNumberOfComponents(), {}};
  for (vtkIdType c = 0; c < array->GetNumberOfTuples(); ++c)
    for (int i = 0; i < field.components; ++i) field.values.push_back(array->GetComponent(c, i));
  return field;
}

mesh::NodeField node_field_of(vtkDataSetAttributes* attributes, vtkDataArraySelection* present, const std::string& name,
                              const std::filesystem::path& path) {
  auto field = field_of(attributes, present, "point", name, path);
  if (field.components != 1)
    refuse(path, fmt::format("point array {} has {} components, one is expected", name, field.components));
  return {name, std::move(field.values)};
}

template <class Grid, class CellTypes>
VtkCells arrays(Grid* grid, vtkCellArray* cell_array, const CellTypes& type_of, const std::filesystem::path& path) {
  VtkCells result;
  const std::int64_t nodes = grid->GetNumberOfPoints(), cells = cell_array ? cell_array->GetNumberOfCells() : 0;
  if (cell_array && !cell_array->IsValid())
    refuse(path, "the offsets of the cells and their points do not belong together");
  result.points.resize(nodes);
  for (std::int64_t n = 0; n < nodes; ++n) grid->GetPoint(n, result.points[n].x);
  result.offsets.push_back(0);
  for (std::int64_t c = 0; c < cells; ++c) {
    vtkIdType size = 0;
    const vtkIdType* corner = nullptr;
    cell_array->GetCellAtId(c, size, corner);
    for (vtkIdType i = 0; i < size; ++i) {
      if (corner[i] < 0 || corner[i] >= nodes)
        refuse(path, fmt::format("cell {} names point {}, but there are points 0 to {}", c + 1, corner[i], nodes - 1));
      result.connectivity.push_back(corner[i]);
    }
    result.offsets.push_back(std::ssize(result.connectivity));
    result.types.push_back(type_of(c, size));
  }
  result.global_node_ids = integers(grid->GetPointData(), node_ids, nodes, path);
  result.global_element_ids = integers(grid->GetCellData(), element_ids, cells, path);
  return result;
}

VtkCells volume_of(vtkXMLUnstructuredGridReader* reader, const std::filesystem::path& path) {
  vtkUnstructuredGrid* grid = reader->GetOutput();
  return arrays(
      grid, grid->GetCells(), [&](std::int64_t c, vtkIdType) { return grid->GetCellType(c); }, path);
}

mesh::ElementField cell_field(vtkXMLUnstructuredGridReader* reader, const std::string& name,
                              const std::filesystem::path& path) {
  return field_of(reader->GetOutput()->GetCellData(), reader->GetCellDataArraySelection(), "cell", name, path);
}

mesh::ElementField point_field(vtkXMLUnstructuredGridReader* reader, const std::string& name,
                               const std::filesystem::path& path) {
  return field_of(reader->GetOutput()->GetPointData(), reader->GetPointDataArraySelection(), "point", name, path);
}

}  // namespace

VtkCells read_vtk_volume(const std::filesystem::path& path, const std::vector<std::string>& fields,
                         const std::vector<std::string>& point_fields, const std::vector<std::string>& optional) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  auto wanted = fields;
  for (const auto* more : {&point_fields, &optional}) wanted.insert(wanted.end(), more->begin(), more->end());
  update(reader.Get(), "UnstructuredGrid", wanted, path);
  VtkCells cells = volume_of(reader, path);
  for (const auto& name : fields) cells.fields.push_back(cell_field(reader, name, path));
  for (const auto& name : point_fields) cells.point_fields.push_back(point_field(reader, name, path));
  auto* points = reader->GetOutput()->GetPointData();
  for (const auto& name : optional)
    if (points->GetArray(name.c_str()))
      cells.node_fields.push_back(node_field_of(points, reader->GetPointDataArraySelection(), name, path));
  return cells;
}

VtkCells read_vtk_volume_with(const std::filesystem::path& path, const std::string& array) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  update(reader.Get(), "UnstructuredGrid", {array}, path);
  VtkCells cells = volume_of(reader, path);
  if (reader->GetOutput()->GetPointData()->GetArray(array.c_str()) != nullptr)
    cells.point_fields.push_back(point_field(reader, array, path));
  else
    cells.fields.push_back(cell_field(reader, array, path));
  return cells;
}

VtkCells read_vtk_surface_series(const std::filesystem::path& path, const std::string& prefix) {
  std::vector<std::string> names;
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    update(reader.Get(), "PolyData", {}, path);
    auto* present = reader->GetPointDataArraySelection();
    for (int i = 0; i < present->GetNumberOfArrays(); ++i)
      if (const std::string name = present->GetArrayName(i); name.starts_with(prefix)) names.push_back(name);
  }
  VtkCells cells = read_vtk_surface(path);
  vtkNew<vtkXMLPolyDataReader> reader;
  update(reader.Get(), "PolyData", names, path);
  for (const auto& name : names)
    cells.point_fields.push_back(
        field_of(reader->GetOutput()->GetPointData(), reader->GetPointDataArraySelection(), "point", name, path));
  return cells;
}

VtkCells read_vtk_surface(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  vtkNew<vtkXMLPolyDataReader> reader;
  update(reader.Get(), "PolyData", fields, path);
  vtkPolyData* surface = reader->GetOutput();
  // Vertices, lines and strips come in arrays of their own; the faces of a volume have none.
  if (surface->GetNumberOfVerts() + surface->GetNumberOfLines() + surface->GetNumberOfStrips() > 0)
    throw InputError(
        path.string(),
        fmt::format("holds {} vertices, {} lines and {} strips beside {} polygons; only triangles are allowed",
                    surface->GetNumberOfVerts(), surface->GetNumberOfLines(), surface->GetNumberOfStrips(),
                    surface->GetNumberOfPolys()),
        surface->GetNumberOfStrips() > 0 ? "turn them into triangles, for example with ParaView's filter Triangulate"
                                         : "remove vertices and lines, for example with ParaView's filters Extract "
                                           "Cells By Type and Extract Surface");
  VtkCells cells = arrays(
      surface, surface->GetPolys(), [](std::int64_t, vtkIdType size) { return size == 3 ? VTK_TRIANGLE : VTK_POLYGON; },
      path);
  for (const auto& name : fields)
    cells.node_fields.push_back(
        node_field_of(surface->GetPointData(), reader->GetPointDataArraySelection(), name, path));
  return cells;
}

}  // namespace tunica::mesh_io
