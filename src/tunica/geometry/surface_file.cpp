#include "tunica/geometry/surface_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"
#include "tunica/mesh_io/vtk_writer.hpp"

namespace tunica::geometry {

namespace {

constexpr const char* accepted = "give a .vtp, .stl, .ply or .obj file of triangles";

TriangleSurface scaled(TriangleSurface surface, double metres_per_unit) {
  for (auto& p : surface.points) p = metres_per_unit * p;
  return surface;
}

[[noreturn]] void refuse_cells(const std::filesystem::path& path, std::int64_t others, std::int64_t cells) {
  throw InputError(path.string(), fmt::format("{} of {} cells are no triangles", others, cells),
                   "triangulate the surface, for example with ParaView's filter Triangulate");
}

TriangleSurface from_vtp(const std::filesystem::path& path) {
  const auto file = mesh_io::read_vtk_surface(path);
  TriangleSurface surface{file.points, {}};
  std::int64_t others = 0;
  for (std::size_t c = 0; c + 1 < file.offsets.size(); ++c) {
    const auto* corner = file.connectivity.data() + file.offsets[c];
    if (file.offsets[c + 1] - file.offsets[c] == 3)
      surface.triangles.push_back({corner[0], corner[1], corner[2]});
    else
      ++others;
  }
  if (others > 0) refuse_cells(path, others, std::ssize(file.types));
  return surface;
}

template <class Reader>
TriangleSurface from_vtk(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  const mesh_io::FirstVtkMessage message(reader.Get());
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!message.text().empty()) throw InputError(path.string(), "cannot be read: " + message.text(), accepted);
  vtkPolyData* data = reader->GetOutput();
  TriangleSurface surface;
  surface.points.resize(data->GetNumberOfPoints());
  for (std::int64_t p = 0; p < std::ssize(surface.points); ++p) data->GetPoint(p, surface.points[p].x);
  std::int64_t others = data->GetNumberOfStrips();
  for (vtkIdType c = 0; c < data->GetPolys()->GetNumberOfCells(); ++c) {
    vtkIdType size = 0;
    const vtkIdType* corner = nullptr;
    data->GetPolys()->GetCellAtId(c, size, corner);
    if (size == 3)
      surface.triangles.push_back({corner[0], corner[1], corner[2]});
    else
      ++others;
  }
  if (others > 0) refuse_cells(path, others, data->GetNumberOfCells());
  return surface;
}

void write(vtkPolyData* data, const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  mesh_io::write_vtk(*writer, path);
}

vtkNew<vtkPoints> vtk_points(const std::vector<Point>& from) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(std::ssize(from));
  for (std::int64_t p = 0; p < std::ssize(from); ++p) points->SetPoint(p, from[p].x);
  return points;
}

void add(vtkFieldData* to, const std::vector<SurfaceArray>& arrays) {
  for (const auto& array : arrays) {
    vtkNew<vtkDoubleArray> values;
    values->SetName(array.name.c_str());
    for (const auto v : array.values) values->InsertNextValue(v);
    to->AddArray(values);
  }
}

vtkNew<vtkStringArray> strings(const char* name, const std::vector<std::string>& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const auto& v : values) array->InsertNextValue(v);
  return array;
}

}  // namespace

TriangleSurface read_surface(const std::filesystem::path& path, double metres_per_unit) {
  if (!(metres_per_unit > 0 && std::isfinite(metres_per_unit)))
    throw InputError(path.string(), fmt::format("length unit of {} m, must be positive", metres_per_unit),
                     "declare the length unit of the surface");
  if (!std::filesystem::is_regular_file(path)) throw InputError(path.string(), "there is no such file", accepted);
  auto extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  TriangleSurface surface;
  if (extension == ".vtp")
    surface = from_vtp(path);
  else if (extension == ".stl")
    surface = from_vtk<vtkSTLReader>(path);
  else if (extension == ".ply")
    surface = from_vtk<vtkPLYReader>(path);
  else if (extension == ".obj")
    surface = from_vtk<vtkOBJReader>(path);
  else
    throw InputError(path.string(), fmt::format("'{}' is no known kind of surface file", extension), accepted);
  if (surface.triangles.empty()) throw InputError(path.string(), "holds no triangles", accepted);
  return scaled(std::move(surface), metres_per_unit);
}

void write_surface(const TriangleSurface& surface, const std::filesystem::path& path,
                   const std::vector<SurfaceArray>& point_arrays, const std::vector<SurfaceArray>& triangle_arrays,
                   const std::vector<std::string>& names) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(surface.points));
  vtkNew<vtkCellArray> cells;
  for (const auto& t : surface.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  data->SetPolys(cells);
  add(data->GetPointData(), point_arrays);
  add(data->GetCellData(), triangle_arrays);
  if (!names.empty()) data->GetFieldData()->AddArray(strings("names", names));
  write(data, path);
}

void write_spots(const std::vector<Spot>& spots, const std::filesystem::path& path) {
  std::vector<Point> places;
  std::vector<std::string> kinds;
  vtkNew<vtkCellArray> cells;
  for (const auto& spot : spots) {
    const auto id = static_cast<vtkIdType>(places.size());
    cells->InsertNextCell(1, &id);
    places.push_back(spot.place);
    kinds.push_back(spot.kind);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(places));
  data->SetVerts(cells);
  data->GetPointData()->AddArray(strings("kind", kinds));
  write(data, path);
}

}  // namespace tunica::geometry
