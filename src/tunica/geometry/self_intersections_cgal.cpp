#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

#include "tunica/geometry/self_intersections.hpp"

namespace tunica::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int64_t>;

class Crossing {
 public:
  explicit Crossing(const TriangleSurface& surface) : surface_(surface) {
    for (const auto& p : surface.points) points_.emplace_back(p[0], p[1], p[2]);
  }

  bool operator()(std::int64_t i, std::int64_t j) const {
    const Triangle &s = surface_.triangles[i], &t = surface_.triangles[j];
    std::vector<int> in_s, in_t;  // shared corners, in the same order
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (s[a] == t[b]) {
          in_s.push_back(a);
          in_t.push_back(b);
        }
    switch (in_s.size()) {
      case 0:
        return CGAL::do_intersect(triangle(s), triangle(t));
      case 1:
        return CGAL::do_intersect(opposite(s, in_s[0]), triangle(t)) ||
               CGAL::do_intersect(opposite(t, in_t[0]), triangle(s));
      case 2:
        return fold(s, t, 3 - in_s[0] - in_s[1], 3 - in_t[0] - in_t[1]);
      default:
        return true;  // the same triangle twice
    }
  }

  bool degenerate(std::int64_t i) const {
    const Triangle& t = surface_.triangles[i];
    return CGAL::collinear(points_[t[0]], points_[t[1]], points_[t[2]]);
  }

  CGAL::Bbox_3 box(std::int64_t i) const { return triangle(surface_.triangles[i]).bbox(); }

 private:
  Kernel::Triangle_3 triangle(const Triangle& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }
  Kernel::Segment_3 opposite(const Triangle& t, int corner) const {
    return {points_[t[(corner + 1) % 3]], points_[t[(corner + 2) % 3]]};
  }
  /// Triangles with a common side overlap only when they lie in one plane on the same side of it.
  bool fold(const Triangle& s, const Triangle& t, int apex_s, int apex_t) const {
    const auto &a = points_[s[(apex_s + 1) % 3]], &b = points_[s[(apex_s + 2) % 3]];
    const auto &p = points_[s[apex_s]], &q = points_[t[apex_t]];
    return CGAL::coplanar(a, b, p, q) && CGAL::coplanar_orientation(a, b, p, q) == CGAL::POSITIVE;
  }

  const TriangleSurface& surface_;
  std::vector<Kernel::Point_3> points_;
};

}  // namespace

std::vector<std::pair<std::int64_t, std::int64_t>> crossing_triangles(const TriangleSurface& surface,
                                                                      const std::vector<bool>& marked) {
  const Crossing crossing(surface);
  std::vector<Box> boxes, marked_boxes;
  for (std::int64_t t = 0; t < std::ssize(surface.triangles); ++t) {
    if (crossing.degenerate(t)) continue;
    boxes.emplace_back(crossing.box(t), t);
    if (!marked.empty() && marked[t]) marked_boxes.push_back(boxes.back());
  }
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  const auto judge = [&](const Box& a, const Box& b) {
    if (a.info() != b.info() && crossing(a.info(), b.info())) pairs.push_back(std::minmax(a.info(), b.info()));
  };
  if (marked.empty())
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), judge);
  else
    CGAL::box_intersection_d(marked_boxes.begin(), marked_boxes.end(), boxes.begin(), boxes.end(), judge);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());  // of two marked ones
  return pairs;
}

}  // namespace tunica::geometry
