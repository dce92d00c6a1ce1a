#include "tunica/geometry/nearby_search.hpp"

#include <algorithm>

namespace tunica::geometry {

SurfacePoint nearest_on(const TriangleTree& tree, const Point& x, std::int64_t triangle) {
  const auto& [points, triangles] = tree.surface();
  const auto& t = triangles[triangle];
  auto found = nearest_on_triangle(x, points[t[0]], points[t[1]], points[t[2]]);
  found.triangle = triangle;
  return found;
}

SurfacePoint nearest_from(const TriangleTree& tree, const Point& x, std::int64_t& near, double within) {
  SurfacePoint known;
  if (near >= 0) known = nearest_on(tree, x, near);
  if (!(known.distance < within)) known = {};
  auto found = tree.nearest(x, std::min(within, known.distance));
  if (!found) found = known;
  if (!found) found.distance = within;  // as the tree has it
  near = found.triangle;
  return found;
}

}  // namespace tunica::geometry
