#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tunica/mesh_io/vtk_writer.hpp"
#include "tunica/stages/post/report_files.hpp"
#include "tunica/stages/post/report_json.hpp"

namespace tunica::stages::post {

namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkFloatArray> array(const char* name, int components = 1) {
  auto result = vtkSmartPointer<vtkFloatArray>::New();
  result->SetName(name);
  result->SetNumberOfComponents(components);
  return result;
}

template <class Writer, class Data>
void write(const fs::path& file, Data* data) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  mesh_io::write_vtk(*writer, file);
}

/// Points of the mesh that cells use, in mm, numbered as they come.
class UsedPoints {
 public:
  explicit UsedPoints(const mesh::MeshData& data) : data_(data), number_(data.points.size(), -1) {}
  vtkIdType operator()(std::int64_t node) {
    auto& number = number_[static_cast<std::size_t>(node)];
    if (number < 0) {
      const auto x = (1 / unit::mm) * data_.points[static_cast<std::size_t>(node)];
      number = points->InsertNextPoint(x.x);
      nodes.push_back(node);
    }
    return number;
  }
  vtkNew<vtkPoints> points;
  std::vector<std::int64_t> nodes;

 private:
  const mesh::MeshData& data_;
  std::vector<vtkIdType> number_;
};

void write_wall_shear(const Findings& f, const fs::path& file) {
  UsedPoints used(f.data);
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : f.vessel.inside) {
    const vtkIdType corners[3] = {used(t[0]), used(t[1]), used(t[2])};
    triangles->InsertNextCell(3, corners);
  }
  const auto tawss = array("TAWSS [Pa]"), osi = array("OSI"), rrt = array("RRT [1/Pa]"),
             mean = array("mean wall shear stress [Pa]", 3), side = array("true lumen");
  const double duration = f.window.until - f.window.from;
  for (const auto node : used.nodes) {
    const double* s = f.fields.shear.data() + 4 * static_cast<std::size_t>(node);
    const auto figures = analysis::shear_figures(s[0], {{s[1], s[2], s[3]}}, duration);
    tawss->InsertNextValue(static_cast<float>(figures.tawss));
    osi->InsertNextValue(static_cast<float>(figures.osi));
    rrt->InsertNextValue(static_cast<float>(figures.rrt));
    mean->InsertNextTuple3(s[1] / duration, s[2] / duration, s[3] / duration);
    if (!f.vessel.side.empty()) side->InsertNextValue(f.vessel.side[static_cast<std::size_t>(node)] > 0 ? 1 : 0);
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(used.points);
  surface->SetPolys(triangles);
  for (const auto& a : {tawss, osi, rrt, mean}) surface->GetPointData()->AddArray(a);
  if (!f.vessel.side.empty()) surface->GetPointData()->AddArray(side);
  write<vtkXMLPolyDataWriter>(file, surface.Get());
}

void write_stress(const Findings& f, const fs::path& file) {
  UsedPoints used(f.data);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIntArray> number;
  number->SetName("region");
  std::vector<vtkSmartPointer<vtkFloatArray>> most;
  for (const auto& name : f.frames.stresses()) most.push_back(array(("largest " + name + " [kPa]").c_str()));
  int region_number = 0;
  for (const auto& region : f.data.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    ++region_number;
    for (auto e = region.first_element; e < region.end_element; ++e) {
      const auto& t = f.data.tetrahedra[static_cast<std::size_t>(e)];
      const vtkIdType corners[4] = {used(t[0]), used(t[1]), used(t[2]), used(t[3])};
      cells->InsertNextCell(4, corners);
      number->InsertNextValue(region_number);
      for (std::size_t q = 0; q < most.size(); ++q)
        most[q]->InsertNextValue(static_cast<float>(f.fields.max_stress[q][static_cast<std::size_t>(e)] / unit::kPa));
    }
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(used.points);
  grid->SetCells(VTK_TETRA, cells);
  grid->GetCellData()->AddArray(number);
  for (const auto& a : most) grid->GetCellData()->AddArray(a);
  write<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

/// Cut surfaces with a number for each, in the reference mesh.
class Surfaces {
 public:
  Surfaces(const mesh::MeshData& data, const char* name) : fields_{.points = &data.points} {
    value->SetName(name);
    lumen->SetName("true lumen");
  }
  void add(const std::vector<analysis::CutTriangle>& surface, double number, int in_true_lumen) {
    for (const auto& t : surface) {
      vtkIdType corners[3];
      for (int i = 0; i < 3; ++i) {
        const auto x = (1 / unit::mm) * analysis::position(t.nodes, t.corners[i], fields_);
        corners[i] = points->InsertNextPoint(x.x);
      }
      triangles->InsertNextCell(3, corners);
      value->InsertNextValue(number);
      lumen->InsertNextValue(in_true_lumen);
    }
  }
  void write_to(const fs::path& file, bool with_lumen) {
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(triangles);
    surface->GetCellData()->AddArray(value);
    if (with_lumen) surface->GetCellData()->AddArray(lumen);
    write<vtkXMLPolyDataWriter>(file, surface.Get());
  }

 private:
  analysis::NodalFields fields_;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkDoubleArray> value;
  vtkNew<vtkIntArray> lumen;
};

}  // namespace

std::vector<std::string> write_fields(const Findings& f, const fs::path& folder) {
  std::vector<std::string> files;
  const auto name = [&](const char* file) {
    files.emplace_back(file);
    return folder / file;
  };
  if (!f.vessel.inside.empty()) write_wall_shear(f, name("wall_shear.vtp"));
  if (!f.frames.stresses().empty()) write_stress(f, name("stress.vtu"));
  if (f.has_stations()) {
    Surfaces sections(f.data, "distance [mm]");
    for (const auto& station : f.vessel.stations)
      for (std::size_t lumen = 0; lumen < 2; ++lumen)
        sections.add(station.sections[lumen], station.distance / unit::mm, lumen == 0 ? 1 : 0);
    sections.write_to(name("stations.vtp"), true);
  }
  if (!f.vessel.tears.empty()) {
    Surfaces tears(f.data, "tear");
    for (std::size_t k = 0; k < f.vessel.tears.size(); ++k)
      tears.add(f.vessel.tears[k].surface, static_cast<double>(k + 1), 0);
    tears.write_to(name("tears.vtp"), false);
  }
  return files;
}

}  // namespace tunica::stages::post
