#include "tunica/geometry/surface_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <new>

#include "tunica/base/error.hpp"
#include "tunica/geometry/surface_formats.hpp"
#include "tunica/mesh_io/extent.hpp"
#include "tunica/mesh_io/vtk_files.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"
#include "tunica/mesh_io/vtk_writer.hpp"

namespace tunica::geometry {

namespace {

constexpr const char* accepted = "give a .vtp, .stl, .ply or .obj file of triangles";

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
  if (others > 0) refuse_polygons(path.string(), others, std::ssize(file.types));
  return surface;
}

std::string whole_file(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !stream)
    throw InputError(path.string(), "there is no such file, or it cannot be read", accepted);
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (content.empty()) throw InputError(path.string(), "is empty", "export or copy the surface again");
  return content;
}

TriangleSurface in_its_unit(const std::filesystem::path& path) {
  auto extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".vtp") return from_vtp(path);
  if (extension == ".stl") return read_stl(whole_file(path), path.string());
  if (extension == ".ply") return read_ply(whole_file(path), path.string());
  if (extension == ".obj") return read_obj(whole_file(path), path.string());
  whole_file(path);  // a missing file comes before its kind
  throw InputError(path.string(), fmt::format("'{}' is no known kind of surface file", extension), accepted);
}

/// Points of triangles; those of no triangle say nothing about the surface.
std::vector<Point> used_points(const TriangleSurface& surface, const std::string& where) {
  std::vector<bool> used(surface.points.size(), false);
  for (const auto& t : surface.triangles)
    for (const auto p : t) used[static_cast<std::size_t>(p)] = true;
  std::vector<Point> points;
  for (std::size_t p = 0; p < used.size(); ++p) {
    if (!used[p]) continue;
    const auto& x = surface.points[p];
    if (!(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])))
      throw InputError(where,
                       fmt::format("the coordinates of point {} are not finite: ({}, {}, {})", p + 1, x[0], x[1], x[2]),
                       "export the surface again");
    points.push_back(x);
  }
  return points;
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
    values->SetNumberOfComponents(array.components);
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

void refuse_polygons(const std::string& where, std::int64_t others, std::int64_t cells) {
  throw InputError(where, fmt::format("{} of {} cells are no triangles", others, cells),
                   "triangulate the surface, for example with ParaView's filter Triangulate");
}

TriangleSurface read_surface(const std::filesystem::path& path, double metres_per_unit) {
  if (!(metres_per_unit > 0 && std::isfinite(metres_per_unit)))
    throw InputError(path.string(), fmt::format("length unit of {} m, must be positive", metres_per_unit),
                     "declare the length unit of the surface");
  TriangleSurface surface;
  try {
    surface = in_its_unit(path);
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), "needs more memory than this machine has", "give a coarser surface");
  }
  if (surface.triangles.empty()) throw InputError(path.string(), "holds no triangles", accepted);
  for (auto& p : surface.points) p = metres_per_unit * p;
  mesh_io::refuse_unlikely_size(used_points(surface, path.string()), metres_per_unit, path.string());
  return surface;
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
