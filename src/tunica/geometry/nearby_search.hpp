// Nearest points for many places, one beside the other.
#pragma once

#include <limits>

#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::geometry {

/// Nearest point of one triangle of the tree's surface.
SurfacePoint nearest_on(const TriangleTree& tree, const Point& x, std::int64_t triangle);

/// As `tree.nearest(x, within)`, which is found sooner where a triangle close to it is known, such as that of a place
/// beside x. `near`: that triangle, or -1; becomes the one that is found.
SurfacePoint nearest_from(const TriangleTree& tree, const Point& x, std::int64_t& near,
                          double within = std::numeric_limits<double>::infinity());

}  // namespace tunica::geometry
