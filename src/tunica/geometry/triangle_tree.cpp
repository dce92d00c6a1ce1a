#include "tunica/geometry/triangle_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace tunica::geometry {

// Voronoi regions of corners, sides and interior (Ericson, Real-Time Collision Detection, 2005, ch. 5.1.5).
SurfacePoint nearest_on_triangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const auto found = [&](double u, double v, double w) {
    const Point place = u * a + v * b + w * c;
    return SurfacePoint{0, place, {{u, v, w}}, norm(x - place)};
  };
  const auto ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return found(1, 0, 0);
  const auto bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return found(0, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return found(1 - v, v, 0);
  }
  const auto cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return found(0, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return found(1 - w, 0, w);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return found(0, 1 - w, w);
  }
  const double sum = va + vb + vc;
  return found(1 - vb / sum - vc / sum, vb / sum, vc / sum);
}

TriangleTree::TriangleTree(TriangleSurface surface) : TriangleTree(std::move(surface), {}) {}

TriangleTree::TriangleTree(TriangleSurface surface, std::vector<double> reach)
    : surface_(std::move(surface)), reach_(std::move(reach)), point_normals_(surface_.points.size(), {{0, 0, 0}}) {
  assert(reach_.empty() || reach_.size() == surface_.points.size());
  const auto& [points, triangles] = surface_;
  std::vector<Point> centres;
  for (const auto& t : triangles) {
    centres.push_back((1.0 / 3) * (points[t[0]] + points[t[1]] + points[t[2]]));
    const auto n = area_vector(surface_, t);
    const double size = norm(n);
    normals_.push_back(size > 0 ? (1 / size) * n : n);
    for (int i = 0; i < 3; ++i) {
      const auto u = points[t[(i + 1) % 3]] - points[t[i]], v = points[t[(i + 2) % 3]] - points[t[i]];
      point_normals_[t[i]] = point_normals_[t[i]] + std::atan2(norm(cross(u, v)), dot(u, v)) * normals_.back();
    }
  }
  for (auto& n : point_normals_)
    if (const double length = norm(n); length > 0) n = (1 / length) * n;
  edge_normals_.resize(triangles.size());
  for (const auto& edge : edges(surface_)) {
    Vec3<double> sum{{0, 0, 0}};
    for (const auto t : edge.triangles) sum = sum + normals_[t];
    for (const auto t : edge.triangles)
      for (int i = 0; i < 3; ++i)
        if (std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]) == std::minmax(edge.a, edge.b))
          edge_normals_[t][i] = sum;
  }
  order_.resize(triangles.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()), centres);
  for (const auto t : order_)
    corners_.push_back({points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]});
}

std::int32_t TriangleTree::build(std::int32_t first, std::int32_t end, std::span<const Point> centres) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr std::int32_t leaf = 4;
  const auto index = static_cast<std::int32_t>(nodes_.size());
  Node node{{{inf, inf, inf}}, {{-inf, -inf, -inf}}, 0, first, end, 0};
  for (auto i = first; i < end; ++i)
    for (const auto corner : surface_.triangles[order_[i]]) {
      if (!reach_.empty()) node.reach = std::max(node.reach, reach_[corner]);
      for (int d = 0; d < 3; ++d) {
        node.low[d] = std::min(node.low[d], surface_.points[corner][d]);
        node.high[d] = std::max(node.high[d], surface_.points[corner][d]);
      }
    }
  nodes_.push_back(node);
  if (end - first <= leaf) return index;
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (node.high[d] - node.low[d] > node.high[axis] - node.low[axis]) axis = d;
  const auto middle = first + (end - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                   [&](auto a, auto b) { return centres[a][axis] < centres[b][axis]; });
  build(first, middle, centres);
  const auto right = build(middle, end, centres);
  nodes_[index].right = right;
  return index;
}

double TriangleTree::box_distance(const Node& node, const Point& x) {
  double square = 0;
  for (int d = 0; d < 3; ++d) {
    const double outside = std::max({node.low[d] - x[d], 0.0, x[d] - node.high[d]});
    square += outside * outside;
  }
  return std::sqrt(square);
}

SurfacePoint TriangleTree::nearest_on(const Point& x, std::int32_t place) const {
  const auto& [a, b, c] = corners_[place];
  auto found = nearest_on_triangle(x, a, b, c);
  found.triangle = order_[place];
  return found;
}

SurfacePoint TriangleTree::nearest(const Point& x, double within) const {
  return nearest_if(x, within, [](const SurfacePoint&) { return true; });
}

SurfacePoint TriangleTree::offset(const Point& x, double within) const {
  assert(!reach_.empty());
  SurfacePoint best;
  best.distance = within;
  descend(
      x, [&] { return best.distance; }, [](const Node& node) { return node.reach; },
      [&](std::int32_t place) {
        // The reach varies little over a triangle, so that the nearest point stands for the best one.
        auto candidate = nearest_on(x, place);
        candidate.distance -= interpolate(reach_, candidate);
        if (candidate.distance < best.distance) best = candidate;
      });
  return best;
}

bool TriangleTree::is_behind(const Point& x, const SurfacePoint& found) const {
  if (!found) return false;
  // Angle-weighted normals decide correctly at sides and corners, too (Baerentzen & Aanaes 2005).
  const auto& t = surface_.triangles[found.triangle];
  const auto& w = found.barycentric;
  constexpr double small = 1e-9;
  auto n = normals_[found.triangle];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    if (w[k] <= small) n = edge_normals_[found.triangle][i];
    if (w[j] <= small && w[k] <= small) {
      n = point_normals_[t[i]];
      break;
    }
  }
  return dot(x - found.place, n) < 0;
}

Vec3<double> TriangleTree::smooth_normal(const SurfacePoint& at) const {
  Vec3<double> sum{{0, 0, 0}};
  for (int i = 0; i < 3; ++i) sum = sum + at.barycentric[i] * point_normals_[surface_.triangles[at.triangle][i]];
  const double length = norm(sum);
  return length > 0 ? (1 / length) * sum : normals_[at.triangle];
}

double TriangleTree::interpolate(std::span<const double> values, const SurfacePoint& at) const {
  const auto& t = surface_.triangles[at.triangle];
  return at.barycentric[0] * values[t[0]] + at.barycentric[1] * values[t[1]] + at.barycentric[2] * values[t[2]];
}

}  // namespace tunica::geometry
