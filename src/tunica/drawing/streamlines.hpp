// Lines along a field of vectors, for pictures of the flow.
#pragma once

#include <string>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace tunica::drawing {

struct StreamlineOptions {
  std::string vector;  ///< point array of three components, full name
  int seeds = 300;     ///< > 0
};

/// Lines through points of the volumes that are spread evenly over their nodes, both ways, by a Runge-Kutta method of
/// fourth and fifth order (VTK), with all point arrays on them. Pieces that share nodes, as those of several ranks, are
/// one field. The caller owns one reference. Throws InputError where there is no line: the vectors vanish everywhere.
vtkPolyData* trace_streamlines(const std::vector<vtkPointSet*>& volumes, const StreamlineOptions& options);

}  // namespace tunica::drawing
