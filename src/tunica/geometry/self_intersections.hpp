// Triangles that cross each other, found with exact predicates.
#pragma once

#include <utility>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// Pairs of triangles with more in common than the corners or the side that they share by number. The surface need not
/// be manifold. Triangles with coinciding corners are left out. `marked`: one for each triangle; then only pairs are
/// looked for of which one at least is marked.
std::vector<std::pair<std::int64_t, std::int64_t>> crossing_triangles(const TriangleSurface& surface,
                                                                      const std::vector<bool>& marked = {});

}  // namespace tunica::geometry
