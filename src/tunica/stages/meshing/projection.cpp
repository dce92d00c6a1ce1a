#include "tunica/stages/meshing/projection.hpp"

#include <algorithm>

namespace tunica::stages::meshing {

Projection projection(const PreparedSurfaces& prepared) {
  return [&prepared](Point& p, const Vec3<double>& normal, int from, int to, double reach) {
    constexpr double same_way = 0.3;
    const auto onto = [&](const TriangleTree& tree) {
      const auto at = tree.nearest_if(
          p, reach, [&](const SurfacePoint& q) { return dot(tree.normal(q.triangle), normal) > same_way; });
      if (at) p = at.place;
      return static_cast<bool>(at);
    };
    if (from == lumen_label && to == wall_label) return onto(prepared.lumen);
    for (const auto& o : prepared.openings) {
      if (!lies_in(o, p) || dot(normal, o.normal) < 0.99) continue;
      p = p - dot(p - o.centre, o.normal) * o.normal;
      return true;
    }
    return from == wall_label && to == outside_label && prepared.outer && onto(*prepared.outer);
  };
}

}  // namespace tunica::stages::meshing
