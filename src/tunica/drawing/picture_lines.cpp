#include "tunica/drawing/picture_lines.hpp"

#include <vtkActor.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <array>
#include <cmath>
#include <set>

namespace tunica::drawing {

namespace {

Vec3<double> centre(vtkPolyData& surface, vtkIdType cell) {
  vtkPoints* points = surface.GetCell(cell)->GetPoints();
  Vec3<double> sum{{0, 0, 0}};
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    Vec3<double> x;
    points->GetPoint(i, x.x);
    sum = sum + x;
  }
  return (1.0 / static_cast<double>(points->GetNumberOfPoints())) * sum;
}

}  // namespace

void add_lines(vtkRenderer& scene, vtkPolyData& surface, const LineLook& look) {
  vtkDataArray* vectors = surface.GetCellData()->GetArray(look.array.c_str());
  if (!vectors) return;  // another layer has them
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  std::set<std::array<long, 3>> taken;
  for (vtkIdType c = 0; c < surface.GetNumberOfCells(); ++c) {
    Vec3<double> v;
    vectors->GetTuple(c, v.x);
    const double size = norm(v);
    if (!(size > 0) || !std::isfinite(size)) continue;
    const auto x = centre(surface, c);
    std::array<long, 3> cube;
    for (int i = 0; i < 3; ++i) cube[i] = std::lround(std::floor(x[i] / (0.7 * look.length)));
    if (!taken.insert(cube).second) continue;
    const auto half = (0.5 * look.length / size) * v, middle = x + (0.25 * look.length) * look.towards;
    const auto a = middle - half, b = middle + half;
    const vtkIdType ends[2] = {points->InsertNextPoint(a.x), points->InsertNextPoint(b.x)};
    lines->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.05, 0.05, 0.05);
  actor->GetProperty()->SetLineWidth(1.5F);
  actor->GetProperty()->LightingOff();
  scene.AddActor(actor);
}

}  // namespace tunica::drawing
