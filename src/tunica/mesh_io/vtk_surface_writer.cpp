#include "tunica/mesh_io/vtk_surface_writer.hpp"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "tunica/mesh_io/vtk_writer.hpp"

namespace tunica::mesh_io {

void write_surface_with_arrays(const SurfaceWithArrays& surface, const std::filesystem::path& file) {
  vtkNew<vtkPoints> points;
  for (const auto& x : surface.points) points->InsertNextPoint(x.x);
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : surface.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    triangles->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  for (const auto& array : surface.arrays) {
    vtkNew<vtkFloatArray> values;
    values->SetName(array.name.c_str());
    values->SetNumberOfComponents(array.components);
    for (const double v : array.values) values->InsertNextValue(static_cast<float>(v));
    data->GetPointData()->AddArray(values);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  write_vtk(*writer, file);
}

}  // namespace tunica::mesh_io
