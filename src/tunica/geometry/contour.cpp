#include "tunica/geometry/contour.hpp"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace tunica::geometry {

TriangleSurface zero_surface(const Grid& grid) {
  vtkNew<vtkFloatArray> values;
  values->SetName("value");
  // VTK only reads the array, and it does not outlive this function.
  values->SetArray(const_cast<float*>(grid.values.data()), static_cast<vtkIdType>(grid.values.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(grid.size[0]), static_cast<int>(grid.size[1]), static_cast<int>(grid.size[2]));
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* data = contour->GetOutput();
  TriangleSurface surface;
  surface.points.resize(data->GetNumberOfPoints());
  for (std::int64_t p = 0; p < std::ssize(surface.points); ++p) {
    Point x;
    data->GetPoint(p, x.x);
    // Positions in grid steps: VTK keeps them in single precision.
    surface.points[p] = grid.origin + grid.spacing * x;
  }
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkIdType size = 0;
    const vtkIdType* corner = nullptr;
    data->GetPolys()->GetCellAtId(c, size, corner);
    // VTK turns them towards lower values.
    surface.triangles.push_back({corner[0], corner[2], corner[1]});
  }
  return surface;
}

}  // namespace tunica::geometry
