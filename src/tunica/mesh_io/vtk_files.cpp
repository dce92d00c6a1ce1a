#include "tunica/mesh_io/vtk_files.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <string>

#include "tunica/base/error.hpp"

namespace tunica::mesh_io {

namespace {

/// Keeps VTK's first error message instead of letting it print.
void keep_first_message(vtkObject*, unsigned long, void* keep, void* message) {
  auto& text = *static_cast<std::string*>(keep);
  if (text.empty() && message) text = static_cast<const char*>(message);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string(), what, "give a readable VTK XML file, or export the mesh again");
}

/// Runs the reader and returns its output, or throws with VTK's own message.
template <class Reader>
void update(Reader* reader, const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) refuse(path, "there is no such file");
  std::string message;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(keep_first_message);
  observer->SetClientData(&message);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->SetFileName(path.c_str());
  if (!reader->CanReadFile(path.c_str())) refuse(path, "is not a VTK XML file of the expected kind");
  reader->Update();
  if (message.empty() && reader->GetErrorCode() == 0) return;
  // VTK puts "ERROR: In <source file>, line <n>\n<class> (<address>): " before what it has to say.
  const auto prefix = message.rfind("): ");
  refuse(path, "cannot be read: " + (prefix == std::string::npos ? message : message.substr(prefix + 3)));
}

std::vector<std::int64_t> integers(vtkDataSetAttributes* attributes, const char* name, std::int64_t expected,
                                   const std::filesystem::path& path) {
  std::vector<std::int64_t> values;
  vtkDataArray* array = attributes->GetArray(name);
  if (!array) return values;
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != expected)
    refuse(path, fmt::format("{} has {} values, {} expected", name, array->GetNumberOfTuples(), expected));
  values.resize(expected);
  for (std::int64_t i = 0; i < expected; ++i) values[i] = static_cast<std::int64_t>(array->GetComponent(i, 0));
  return values;
}

/// `kind`: "cell" or "point".
mesh::ElementField field_of(vtkDataSetAttributes* attributes, const char* kind, const std::string& name,
                            const std::filesystem::path& path) {
  vtkDataArray* array = attributes->GetArray(name.c_str());
  if (!array) {
    std::string names;
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      if (const char* other = attributes->GetArrayName(i)) names += (names.empty() ? "" : ", ") + std::string(other);
    throw InputError(
        path.string(), fmt::format("there is no numeric {} array called {}", kind, name),
        names.empty() ? fmt::format("write one to the file, it has no {} arrays", kind) : "use one of: " + names);
  }
  mesh::ElementField field{name, array->GetNumberOfComponents(), {}};
  for (vtkIdType c = 0; c < array->GetNumberOfTuples(); ++c)
    for (int i = 0; i < field.components; ++i) field.values.push_back(array->GetComponent(c, i));
  return field;
}

template <class Grid, class CellTypes>
VtkCells arrays(Grid* grid, vtkCellArray* cell_array, const CellTypes& type_of, const std::filesystem::path& path) {
  VtkCells result;
  const std::int64_t nodes = grid->GetNumberOfPoints(), cells = cell_array->GetNumberOfCells();
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
  result.global_node_ids = integers(grid->GetPointData(), "GlobalNodeID", nodes, path);
  result.global_element_ids = integers(grid->GetCellData(), "GlobalElementID", cells, path);
  return result;
}

}  // namespace

VtkCells read_vtk_volume(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  update(reader.Get(), path);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  VtkCells cells = arrays(
      grid, grid->GetCells(), [&](std::int64_t c, vtkIdType) { return grid->GetCellType(c); }, path);
  for (const auto& name : fields) cells.fields.push_back(field_of(grid->GetCellData(), "cell", name, path));
  return cells;
}

VtkCells read_vtk_surface(const std::filesystem::path& path, const std::vector<std::string>& fields) {
  vtkNew<vtkXMLPolyDataReader> reader;
  update(reader.Get(), path);
  vtkPolyData* surface = reader->GetOutput();
  // Vertices, lines and strips come in arrays of their own; the faces of a volume have none.
  if (surface->GetNumberOfVerts() + surface->GetNumberOfLines() + surface->GetNumberOfStrips() > 0)
    refuse(path, fmt::format("holds {} vertices, {} lines and {} strips beside {} polygons; only triangles are allowed",
                             surface->GetNumberOfVerts(), surface->GetNumberOfLines(), surface->GetNumberOfStrips(),
                             surface->GetNumberOfPolys()));
  VtkCells cells = arrays(
      surface, surface->GetPolys(), [](std::int64_t, vtkIdType size) { return size == 3 ? VTK_TRIANGLE : VTK_POLYGON; },
      path);
  for (const auto& name : fields) {
    auto field = field_of(surface->GetPointData(), "point", name, path);
    if (field.components != 1)
      refuse(path, fmt::format("point array {} has {} components, one is expected", name, field.components));
    cells.node_fields.push_back({name, std::move(field.values)});
  }
  return cells;
}

}  // namespace tunica::mesh_io
