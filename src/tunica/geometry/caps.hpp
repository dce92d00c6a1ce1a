// Plane pieces that close a surface at its openings.
#pragma once

#include <span>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// Triangles of the plane region inside the closed chain `outer` and outside `inner` (empty: no hole), with edges about
/// as long as those of the chains next to them. `normal`: unit, of the plane and of the triangles. The chains may run
/// either way around; their points [m] come first in the result, outer before inner, unchanged. SolverError if the
/// chains cross.
TriangleSurface plane_cap(std::span<const Point> outer, std::span<const Point> inner, const Vec3<double>& normal);

}  // namespace tunica::geometry
