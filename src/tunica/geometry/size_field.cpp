#include "tunica/geometry/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "tunica/base/limits.hpp"
#include "tunica/geometry/nearby_search.hpp"

namespace tunica::geometry {

namespace {

using base::infinity;

/// Neighbours of each point along edges.
std::vector<std::vector<std::int64_t>> neighbours(const TriangleSurface& surface) {
  std::vector<std::vector<std::int64_t>> result(surface.points.size());
  for (const auto& edge : edges(surface)) {
    result[edge.a].push_back(edge.b);
    result[edge.b].push_back(edge.a);
  }
  return result;
}

/// By the diameter of the lumen. Edges inside come out longer than wanted, by this factor in tubes (docs/meshing.md).
double size_across(double diameter, const SizeSettings& settings) {
  constexpr double longer = 1.25;
  return std::clamp(diameter / (longer * *settings.across), settings.smallest_across, settings.largest);
}

/// Ball that touches the surface of `lumen` at p, where its normal is n, and a wall that faces p: its diameter and the
/// triangle there. A large ball shrinks until no such wall is within it. `near`: triangles where balls beside this one
/// touch, which make it small at once; -1 where none is known.
std::pair<double, std::int64_t> largest_ball(const TriangleTree& lumen, const Point& p, const Vec3<double>& n,
                                             double reach, std::span<const std::int64_t> near) {
  constexpr double facing = 0.7, enough = 0.98;
  const auto faces = [&](std::int64_t triangle) { return dot(lumen.normal(triangle), n) < -facing; };
  double radius = 0.5 * reach;
  std::int64_t touched = -1;
  const auto shrink = [&](const SurfacePoint& q) {
    touched = q.triangle;
    const auto d = q.place - p;
    radius = dot(d, d) / (-2 * dot(d, n));  // through p and q; smaller, since q was inside
  };
  for (const auto t : near)
    if (t >= 0 && faces(t))
      if (const auto q = nearest_on(lumen, p - radius * n, t); q.distance < enough * radius) shrink(q);
  for (;;) {
    const auto q = lumen.nearest_of(p - radius * n, enough * radius, faces, [](const SurfacePoint&) { return true; });
    if (!q) return {touched < 0 ? infinity : 2 * radius, touched};
    const double before = radius;
    shrink(q);
    if (!(radius < before)) return {2 * before, touched};  // walls touch at p, and rounding is all that is left
  }
}

}  // namespace

SizeField::SizeField(TriangleSurface surface, std::vector<double> sizes, double gradation, double largest)
    : tree_(std::move(surface)), sizes_(std::move(sizes)), gradation_(gradation), largest_(largest) {}

double SizeField::operator()(const Point& x) const {
  // Beyond this distance the growth has reached the largest size anyway.
  const auto at = tree_.nearest(x, largest_ / gradation_);
  return at ? std::min(largest_, tree_.interpolate(sizes_, at) + gradation_ * at.distance) : largest_;
}

Thickness wall_thickness(const TriangleTree& lumen, const TriangleTree* outer, double reach) {
  const auto& points = lumen.surface().points;
  const auto normals = point_normals(lumen.surface());
  Thickness thickness{std::vector<double>(points.size(), infinity), std::vector<std::uint8_t>(points.size(), 0)};
  // Within 60 degrees in front; facing by more than a right angle plus what a curved wall turns over its thickness.
  constexpr double in_front = 0.5, facing = 0.3;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto& n = normals[p];
    const auto ahead = [&](const SurfacePoint& q) { return dot(q.place - points[p], n) > in_front * q.distance; };
    const auto across = lumen.nearest_if(points[p], reach, [&](const SurfacePoint& q) {
      return dot(lumen.normal(q.triangle), n) < -facing && ahead(q);
    });
    if (across) thickness.value[p] = across.distance;
    thickness.flap[p] = static_cast<bool>(across);
    if (!outer) continue;
    const auto outside = outer->nearest_if(points[p], std::min(reach, thickness.value[p]), [&](const SurfacePoint& q) {
      return dot(outer->normal(q.triangle), n) > facing && ahead(q);
    });
    if (!outside) continue;
    thickness.value[p] = outside.distance;
    thickness.flap[p] = 0;
  }
  return thickness;
}

LumenDiameter lumen_diameter(const TriangleTree& lumen, double reach) {
  const auto& points = lumen.surface().points;
  const auto normals = point_normals(lumen.surface());
  LumenDiameter diameter{std::vector<double>(points.size(), infinity), std::vector<std::int64_t>(points.size(), -1)};
  const auto beside = neighbours(lumen.surface());
  std::vector<std::int64_t> near;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!(norm(normals[p]) > 0)) continue;
    near.clear();
    for (const auto q : beside[p]) near.push_back(diameter.facing[q]);
    std::tie(diameter.value[p], diameter.facing[p]) = largest_ball(lumen, points[p], normals[p], reach, near);
  }
  return diameter;
}

std::vector<double> curvature_radius(const TriangleSurface& surface) {
  const auto near = neighbours(surface);
  auto normals = point_normals(surface);
  for (int sweep = 0; sweep < 2; ++sweep) {
    const auto before = normals;
    for (std::size_t p = 0; p < near.size(); ++p) {
      for (const auto q : near[p]) normals[p] = normals[p] + before[q];
      if (const double length = norm(normals[p]); length > 0) normals[p] = (1 / length) * normals[p];
    }
  }
  std::vector<double> radius(surface.points.size(), infinity);
  for (std::size_t p = 0; p < near.size(); ++p)
    for (const auto q : near[p]) {
      const auto e = surface.points[q] - surface.points[p];
      const double turn = std::abs(dot(normals[q] - normals[p], e));
      if (turn > 0) radius[p] = std::min(radius[p], dot(e, e) / turn);
    }
  return radius;
}

void limit_gradation(const TriangleSurface& surface, double gradation, std::vector<double>& sizes) {
  const auto near = neighbours(surface);
  using Entry = std::pair<double, std::int64_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::int64_t p = 0; p < std::ssize(sizes); ++p) queue.emplace(sizes[p], p);
  while (!queue.empty()) {
    const auto [size, p] = queue.top();
    queue.pop();
    if (size > sizes[p]) continue;
    for (const auto q : near[p]) {
      const double allowed = size + gradation * norm(surface.points[q] - surface.points[p]);
      if (allowed >= sizes[q]) continue;
      sizes[q] = allowed;
      queue.emplace(allowed, q);
    }
  }
}

std::vector<double> surface_sizes(const TriangleSurface& surface, std::span<const double> thickness,
                                  std::span<const double> diameter, const SizeSettings& settings) {
  auto sizes = curvature_radius(surface);
  for (std::size_t p = 0; p < sizes.size(); ++p) {
    sizes[p] *= settings.per_radius;
    if (!thickness.empty()) sizes[p] = std::min(sizes[p], settings.per_thickness * thickness[p]);
    sizes[p] = std::clamp(sizes[p], settings.smallest, settings.largest);
    if (settings.across && !diameter.empty()) sizes[p] = std::min(sizes[p], size_across(diameter[p], settings));
  }
  limit_gradation(surface, settings.gradation, sizes);
  return sizes;
}

std::vector<double> lumen_sizes(const TriangleSurface& surface, std::span<const double> diameter,
                                const SizeSettings& settings) {
  std::vector<double> sizes;
  for (const double d : diameter) sizes.push_back(size_across(d, settings));
  limit_gradation(surface, settings.gradation, sizes);
  return sizes;
}

}  // namespace tunica::geometry
