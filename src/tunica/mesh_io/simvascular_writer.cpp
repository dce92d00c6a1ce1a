#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/mesh_io/volume_arrays.hpp"
#include "tunica/mesh_io/vtk_writer.hpp"

namespace tunica::mesh_io {

namespace {

namespace fs = std::filesystem;
using Index = std::int64_t;

template <class Writer, class Data>
void write(const fs::path& path, Data* data) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  write_vtk(*writer, path);
}

/// Nodes and elements of one kind of region, numbered from 0.
struct Part {
  std::vector<Index> node, element;                        ///< numbers in the part, -1: not in it
  std::vector<Index> nodes, elements;                      ///< numbers in the whole
  std::vector<std::pair<std::string, Index>> region_ends;  ///< name, end in `elements`
};

Part make_part(const mesh::MeshData& data, mesh::RegionKind kind) {
  Part part{std::vector<Index>(data.points.size(), -1), std::vector<Index>(data.tetrahedra.size(), -1), {}, {}, {}};
  for (const auto& region : data.regions) {
    if (region.kind != kind) continue;
    for (auto e = region.first_element; e < region.end_element; ++e) {
      part.element[e] = std::ssize(part.elements);
      part.elements.push_back(e);
      for (const auto n : data.tetrahedra[e]) part.node[n] = 0;
    }
    part.region_ends.emplace_back(region.name, std::ssize(part.elements));
  }
  for (Index n = 0; n < std::ssize(part.node); ++n) {
    if (part.node[n] < 0) continue;
    part.node[n] = std::ssize(part.nodes);
    part.nodes.push_back(n);
  }
  return part;
}

/// As Int32, the only type of numbers that SimVascular and svMultiPhysics read here.
vtkNew<vtkIntArray> id_array(const char* name, const std::vector<Index>& zero_based) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfValues(std::ssize(zero_based));
  for (Index i = 0; i < std::ssize(zero_based); ++i) array->SetValue(i, static_cast<int>(zero_based[i] + 1));
  return array;
}

vtkNew<vtkDoubleArray> field_array(const mesh::ElementField& field, const std::vector<Index>& elements) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(field.components);
  array->SetNumberOfTuples(std::ssize(elements));
  for (Index i = 0; i < std::ssize(elements); ++i)
    array->SetTuple(i, field.values.data() + elements[i] * field.components);
  return array;
}

vtkNew<vtkDoubleArray> field_array(const mesh::NodeField& field, const std::vector<Index>& nodes) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfValues(std::ssize(nodes));
  for (Index i = 0; i < std::ssize(nodes); ++i) array->SetValue(i, field.values[nodes[i]]);
  return array;
}

vtkNew<vtkPoints> points(const mesh::MeshData& data, const std::vector<Index>& nodes, double metres_per_unit) {
  vtkNew<vtkPoints> result;
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(std::ssize(nodes));
  for (Index i = 0; i < std::ssize(nodes); ++i) {
    const auto x = (1 / metres_per_unit) * data.points[nodes[i]];
    result->SetPoint(i, x[0], x[1], x[2]);
  }
  return result;
}

std::vector<Index> counted(Index n) {
  std::vector<Index> numbers(n);
  for (Index i = 0; i < n; ++i) numbers[i] = i;
  return numbers;
}

void set_shape(vtkUnstructuredGrid* grid, const mesh::MeshData& data, const Part& part, double metres_per_unit) {
  grid->SetPoints(points(data, part.nodes, metres_per_unit));
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(std::ssize(part.elements), 4 * std::ssize(part.elements));
  for (const auto e : part.elements) {
    vtkIdType corners[4];
    for (int a = 0; a < 4; ++a) corners[a] = part.node[data.tetrahedra[e][a]];
    cells->InsertNextCell(4, corners);
  }
  grid->SetCells(VTK_TETRA, cells);
}

void write_volume(const fs::path& path, const mesh::MeshData& data, const Part& part, mesh::RegionKind kind,
                  double metres_per_unit) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_shape(grid, data, part, metres_per_unit);
  vtkNew<vtkIntArray> region;
  region->SetName("region");
  region->SetNumberOfValues(std::ssize(part.elements));
  Index e = 0;
  for (std::size_t r = 0; r < part.region_ends.size(); ++r)
    for (; e < part.region_ends[r].second; ++e) region->SetValue(e, static_cast<int>(r) + 1);
  grid->GetCellData()->AddArray(region);
  for (const auto& field : data.fields) grid->GetCellData()->AddArray(field_array(field, part.elements));
  for (const auto& field : data.node_fields)
    if (kind == mesh::RegionKind::lumen &&
        std::find(mesh::lumen_fields.begin(), mesh::lumen_fields.end(), field.name) != mesh::lumen_fields.end())
      grid->GetPointData()->AddArray(field_array(field, part.nodes));
  grid->GetPointData()->AddArray(id_array("GlobalNodeID", counted(std::ssize(part.nodes))));
  grid->GetCellData()->AddArray(id_array("GlobalElementID", counted(std::ssize(part.elements))));
  write<vtkXMLUnstructuredGridWriter>(path, grid.Get());
}

/// `faces`: all in one file, told apart by ModelFaceID.
void write_surface(const fs::path& path, const mesh::MeshData& data, const Part& part, const mesh::Boundary& boundary,
                   const std::vector<const mesh::FaceData*>& faces, double metres_per_unit) {
  std::vector<Index> number(data.points.size(), -1), nodes, elements;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> face_id;
  face_id->SetName("ModelFaceID");
  int id = 0;
  for (const auto* face : faces) {
    ++id;
    for (const auto& t : face->triangles) {
      vtkIdType corners[3];
      for (int a = 0; a < 3; ++a) {
        if (number[t[a]] < 0) {
          number[t[a]] = std::ssize(nodes);
          nodes.push_back(t[a]);
        }
        corners[a] = number[t[a]];
      }
      cells->InsertNextCell(3, corners);
      face_id->InsertNextValue(id);
      elements.push_back(part.element[boundary.triangles()[boundary.find(t)].element]);
    }
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points(data, nodes, metres_per_unit));
  surface->SetPolys(cells);
  for (auto& n : nodes) n = part.node[n];
  surface->GetPointData()->AddArray(id_array("GlobalNodeID", nodes));
  surface->GetCellData()->AddArray(id_array("GlobalElementID", elements));
  surface->GetCellData()->AddArray(face_id);
  write<vtkXMLPolyDataWriter>(path, surface.Get());
}

void make_empty_surface_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw SolverError(folder.string() + ": cannot be made: " + error.message());
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".vtp") fs::remove(entry.path());
}

}  // namespace

std::vector<std::string> write_simvascular(const fs::path& folder, const mesh::MeshData& data, mesh::RegionKind kind,
                                           double metres_per_unit) {
  const Part part = make_part(data, kind);
  if (const auto largest = std::max(std::ssize(part.nodes), std::ssize(part.elements));
      largest > std::numeric_limits<int>::max())
    throw SolverError(fmt::format("{}: {} nodes or elements, the format can number {}", folder.string(), largest,
                                  std::numeric_limits<int>::max()));
  make_empty_surface_folder(folder / "mesh-surfaces");
  write_volume(folder / "mesh-complete.mesh.vtu", data, part, kind, metres_per_unit);
  const mesh::Boundary boundary(data.tetrahedra, std::ssize(data.points), folder.string());
  std::vector<const mesh::FaceData*> faces;
  for (const auto& face : data.faces)
    if (data.regions[face.region].kind == kind) faces.push_back(&face);
  for (const auto* face : faces)
    write_surface(folder / "mesh-surfaces" / (face->name + ".vtp"), data, part, boundary, {face}, metres_per_unit);
  write_surface(folder / "mesh-complete.exterior.vtp", data, part, boundary, faces, metres_per_unit);
  std::vector<std::string> names;
  for (const auto& [name, end] : part.region_ends) names.push_back(name);
  return names;
}

void write_volume_array(const fs::path& file, const mesh::MeshData& data, mesh::RegionKind kind, double metres_per_unit,
                        const VolumeArray& array) {
  const Part part = make_part(data, kind);
  const bool of_nodes = array.of == VolumeArray::Of::nodes;
  const auto& entities = of_nodes ? part.nodes : part.elements;
  vtkNew<vtkUnstructuredGrid> grid;
  set_shape(grid, data, part, metres_per_unit);
  vtkSmartPointer<vtkDataArray> values;
  if (array.whole_numbers)
    values = vtkSmartPointer<vtkIntArray>::New();
  else
    values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(array.name.c_str());
  values->SetNumberOfComponents(array.components);
  values->SetNumberOfTuples(std::ssize(entities));
  for (Index i = 0; i < std::ssize(entities); ++i)
    values->SetTuple(i, array.values.data() + entities[static_cast<std::size_t>(i)] * array.components);
  if (of_nodes)
    grid->GetPointData()->AddArray(values);
  else
    grid->GetCellData()->AddArray(values);
  grid->GetPointData()->AddArray(id_array("GlobalNodeID", counted(std::ssize(part.nodes))));
  grid->GetCellData()->AddArray(id_array("GlobalElementID", counted(std::ssize(part.elements))));
  write<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

}  // namespace tunica::mesh_io
