// How thick a body is at a point of its surface.
#pragma once

#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::geometry {

/// Diameter [m] of the largest ball inside the body that touches its surface at `x`: the distance of two parallel
/// faces, and at an edge that is cut off at right angles that of the faces behind it. By the shrinking ball of Ma, Bae
/// & Choi, Vis Comput 28, 7-19 (2012). `normal`: unit, outward at x; `most` [m]: no ball is larger. Triangles that are
/// turned by less than 60 degrees from it bound nothing: so small kinks at x do not.
double thickness_at(const TriangleTree& surface, const Point& x, const Vec3<double>& normal, double most);

}  // namespace tunica::geometry
