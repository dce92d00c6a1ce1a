#include "tunica/meshing/projection.hpp"

#include <algorithm>

namespace tunica::meshing {

Projection projection(const PreparedSurfaces& prepared) {
  return [&prepared](geometry::Point& p, const Vec3<double>& normal, int from, int to, double reach) {
    constexpr double same_way = 0.3;
    const auto onto = [&](const geometry::TriangleTree& tree) {
      const auto at = tree.nearest_if(
          p, reach, [&](const geometry::SurfacePoint& q) { return dot(tree.normal(q.triangle), normal) > same_way; });
      if (at) p = at.place;
      return static_cast<bool>(at);
    };
    if (from == geometry::lumen_label && to == geometry::wall_label) return onto(prepared.lumen);
    for (const auto& o : prepared.openings) {
      if (!geometry::lies_in(o, p) || dot(normal, o.normal) < 0.99) continue;
      p = p - dot(p - o.centre, o.normal) * o.normal;
      return true;
    }
    return from == geometry::wall_label && to == geometry::outside_label && prepared.outer && onto(*prepared.outer);
  };
}

}  // namespace tunica::meshing
