#include "tunica/drawing/streamlines.hpp"

#include <fmt/format.h>
#include <vtkAppendFilter.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamTracer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::drawing {

namespace {

/// Every so many nodes at which something moves: those on a wall at rest are no seeds.
vtkSmartPointer<vtkPolyData> seeds_in(vtkDataSet& field, vtkDataArray& vectors, int count) {
  std::vector<vtkIdType> moving;
  double x[3];
  for (vtkIdType i = 0; i < field.GetNumberOfPoints(); ++i) {
    vectors.GetTuple(i, x);
    if (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] > 0) moving.push_back(i);
  }
  vtkNew<vtkPoints> points;
  const std::size_t wanted = std::min(moving.size(), static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < wanted; ++k) {
    field.GetPoint(moving[k * moving.size() / wanted], x);
    points->InsertNextPoint(x);
  }
  auto seeds = vtkSmartPointer<vtkPolyData>::New();
  seeds->SetPoints(points);
  return seeds;
}

}  // namespace

vtkPolyData* trace_streamlines(const std::vector<vtkPointSet*>& volumes, const StreamlineOptions& options) {
  vtkNew<vtkAppendFilter> whole;
  whole->MergePointsOn();
  for (auto* volume : volumes) whole->AddInputData(volume);
  whole->Update();
  vtkUnstructuredGrid* field = whole->GetOutput();
  vtkDataArray* vectors = field->GetPointData()->GetArray(options.vector.c_str());
  const auto seeds = seeds_in(*field, *vectors, options.seeds);
  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(field);
  tracer->SetSourceData(seeds);
  tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.vector.c_str());
  tracer->SetIntegratorTypeToRungeKutta45();
  tracer->SetIntegrationDirectionToBoth();
  tracer->SetMaximumPropagation(2 * field->GetLength());
  tracer->SetComputeVorticity(false);
  tracer->Update();
  vtkPolyData* lines = tracer->GetOutput();
  if (lines->GetNumberOfLines() == 0)
    throw InputError("picture streamlines", fmt::format("`{}` vanishes everywhere at this time", options.vector),
                     "choose another time by --time");
  lines->Register(nullptr);
  return lines;
}

}  // namespace tunica::drawing
