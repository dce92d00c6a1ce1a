// A bounding-box tree over triangles: nearest points, with conditions and with weights.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

struct SurfacePoint {
  std::int64_t triangle = -1;  ///< -1: none was found
  Point place = {};
  Vec3<double> barycentric = {};  ///< of `place` in the triangle
  double distance = std::numeric_limits<double>::infinity();
  explicit operator bool() const { return triangle >= 0; }
};

/// Nearest point of one triangle; `triangle` of the result is 0.
SurfacePoint nearest_on_triangle(const Point& x, const Point& a, const Point& b, const Point& c);

/// Keeps a copy of the surface. Look-ups are logarithmic and may run in parallel.
class TriangleTree {
 public:
  explicit TriangleTree(TriangleSurface surface);
  /// With a reach [m] >= 0 for each point, interpolated linearly over the triangles; see `offset`.
  TriangleTree(TriangleSurface surface, std::vector<double> reach);

  const TriangleSurface& surface() const { return surface_; }

  /// Nearest point that is closer than `within`.
  SurfacePoint nearest(const Point& x, double within = std::numeric_limits<double>::infinity()) const;

  /// Nearest point that `accept(point)` allows. It is asked for the nearest point of a triangle only.
  template <class Accept>
  SurfacePoint nearest_if(const Point& x, double within, const Accept& accept) const {
    return nearest_of(
        x, within, [](std::int64_t) { return true; }, accept);
  }

  /// The same among the triangles that `consider(triangle)` allows, which is asked first.
  template <class Consider, class Accept>
  SurfacePoint nearest_of(const Point& x, double within, const Consider& consider, const Accept& accept) const {
    SurfacePoint best;
    best.distance = within;
    descend(
        x, [&] { return best.distance; }, [](const Node&) { return 0.0; },
        [&](std::int32_t place) {
          if (!consider(order_[place])) return;
          auto candidate = nearest_on(x, place);
          if (candidate.distance < best.distance && accept(candidate)) best = candidate;
        });
    return best;
  }

  /// The point q with the smallest |x - q| - reach(q); `distance` is that difference, which is negative within reach.
  /// Only values below `within` are looked for.
  SurfacePoint offset(const Point& x, double within) const;

  /// Whether x lies inside: the surface is closed and its normals point outward. Decided at the nearest point.
  bool contains(const Point& x) const { return is_behind(x, nearest(x)); }
  /// The same with the nearest point at hand.
  bool is_behind(const Point& x, const SurfacePoint& nearest) const;

  /// A value given at the points, interpolated at a point of the surface.
  double interpolate(std::span<const double> values, const SurfacePoint& at) const;
  Vec3<double> normal(std::int64_t triangle) const { return normals_[triangle]; }  ///< unit
  /// Unit normal interpolated between the points, for which it is weighted by angles.
  Vec3<double> smooth_normal(const SurfacePoint& at) const;

 private:
  struct Node {
    Point low, high;
    double reach = 0;                 ///< largest one inside
    std::int32_t first = 0, end = 0;  /// of a leaf: range in order_; of others: first = -1, the children follow
    std::int32_t right = 0;           ///< second child; the first is the next node
  };

  SurfacePoint nearest_on(const Point& x, std::int32_t place) const;
  std::int32_t build(std::int32_t first, std::int32_t end, std::span<const Point> centres);
  static double box_distance(const Node& node, const Point& x);

  /// Visits the places in `order_` of the triangles of all leaves whose distance less `slack` is below `bound`, near
  /// ones first.
  template <class Bound, class Slack, class Visit>
  void descend(const Point& x, const Bound& bound, const Slack& slack, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::pair<std::int32_t, double> stack[96];
    int top = 0;
    stack[top++] = {0, box_distance(nodes_[0], x) - slack(nodes_[0])};
    while (top > 0) {
      const auto [index, distance] = stack[--top];
      if (distance >= bound()) continue;
      const Node& node = nodes_[index];
      if (node.right == 0) {
        for (auto i = node.first; i < node.end; ++i) visit(i);
        continue;
      }
      std::pair<std::int32_t, double> left{index + 1, box_distance(nodes_[index + 1], x) - slack(nodes_[index + 1])};
      std::pair<std::int32_t, double> right{node.right,
                                            box_distance(nodes_[node.right], x) - slack(nodes_[node.right])};
      if (left.second < right.second) std::swap(left, right);
      stack[top++] = left;
      stack[top++] = right;
    }
  }

  TriangleSurface surface_;
  std::vector<double> reach_;
  std::vector<Vec3<double>> normals_;
  std::vector<Vec3<double>> point_normals_;                ///< angle-weighted
  std::vector<std::array<Vec3<double>, 3>> edge_normals_;  ///< of the edge after each corner
  std::vector<std::int64_t> order_;                        ///< triangles, those of a leaf one after the other
  std::vector<std::array<Point, 3>> corners_;  ///< of the triangles in this order: look-ups read no other memory
  std::vector<Node> nodes_;
};

}  // namespace tunica::geometry
