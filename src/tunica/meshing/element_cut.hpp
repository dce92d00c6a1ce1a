// Where a linear function is zero within a tetrahedron.
#pragma once

#include <array>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::meshing {

/// Corners in order of the polygon on which a function is zero that has `values` at the corners of the element: three,
/// four or none. Zero counts as negative.
std::vector<geometry::Point> zero_polygon(const std::array<geometry::Point, 4>& corners,
                                          const std::array<double, 4>& values);

}  // namespace tunica::meshing
