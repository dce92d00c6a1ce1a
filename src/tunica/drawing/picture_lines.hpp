// Short lines along a vector array, for pictures of directions.
#pragma once

#include <string>

#include "tunica/base/tensor.hpp"

class vtkRenderer;
class vtkPolyData;

namespace tunica::drawing {

struct LineLook {
  std::string array;     ///< cell array of three components, full name
  double length;         ///< in the unit of the file, > 0
  Vec3<double> towards;  ///< unit vector to the camera: lines are lifted off the surface that way
};

/// One line through the middle of a surface cell in each cube of 0.7 lengths: evenly spread whatever the mesh. Vectors
/// are drawn without sign and with one length; zeros and NaN are left out.
void add_lines(vtkRenderer& scene, vtkPolyData& surface, const LineLook& look);

}  // namespace tunica::drawing
