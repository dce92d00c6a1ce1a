#include "tunica/geometry/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tunica/base/error.hpp"

namespace tunica::geometry {

namespace {

/// Points beyond the plane that belong to the end: flooded along edges from the ones in the end's cylinder.
std::vector<bool> points_of_end(const TriangleSurface& surface, const std::vector<double>& height,
                                const VesselEnd& end) {
  const auto off_axis = [&](std::int64_t p) {
    const auto x = surface.points[p] - end.centre;
    return norm(x - dot(x, end.normal) * end.normal);
  };
  std::vector<std::vector<std::int64_t>> near(surface.points.size());
  for (const auto& edge : edges(surface)) {
    near[edge.a].push_back(edge.b);
    near[edge.b].push_back(edge.a);
  }
  // The start lies just beyond the plane, where no other vessel comes between.
  std::int64_t start = -1;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::int64_t p = 0; p < std::ssize(height); ++p)
    if (height[p] > 0 && height[p] < lowest && off_axis(p) < end.radius && !near[p].empty()) {
      lowest = height[p];
      start = p;
    }
  std::vector<bool> beyond(surface.points.size(), false);
  std::vector<std::int64_t> stack;
  if (start >= 0) stack.push_back(start);
  while (!stack.empty()) {
    const auto p = stack.back();
    stack.pop_back();
    if (beyond[p]) continue;
    if (off_axis(p) > end.radius)
      throw SolverError("the vessel end at " + list_places_mm({{end.centre}}) +
                        " cannot be cut off: its plane touches another vessel, or the blind end of one, near " +
                        list_places_mm({{surface.points[p]}}) + "; give its opening a `normal`, or another centre");
    beyond[p] = true;
    for (const auto q : near[p])
      if (height[q] > 0 && !beyond[q]) stack.push_back(q);
  }
  return beyond;
}

}  // namespace

TriangleSurface cut_end(const TriangleSurface& surface, const VesselEnd& end) {
  TriangleSurface result{surface.points, {}};
  std::vector<double> height;
  for (const auto& p : surface.points) height.push_back(dot(p - end.centre, end.normal));
  const auto beyond = points_of_end(surface, height, end);
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> made;
  const auto between = [&](std::int64_t in, std::int64_t out) {
    const auto [entry, is_new] = made.emplace(std::pair{in, out}, std::ssize(result.points));
    if (is_new) {
      const double s = height[in] / (height[in] - height[out]);
      auto x = surface.points[in] + s * (surface.points[out] - surface.points[in]);
      x = x - dot(x - end.centre, end.normal) * end.normal;
      result.points.push_back(x);
    }
    return entry->second;
  };
  for (const auto& t : surface.triangles) {
    const int count = beyond[t[0]] + beyond[t[1]] + beyond[t[2]];
    if (count == 0) result.triangles.push_back(t);
    if (count == 0 || count == 3) continue;
    // Turned so that the corner that is alone on its side comes first.
    int first = 0;
    while (beyond[t[first]] != (count == 1)) ++first;
    const auto a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    if (count == 2) {
      result.triangles.push_back({a, between(a, b), between(a, c)});
    } else {
      result.triangles.push_back({between(b, a), b, c});
      result.triangles.push_back({between(b, a), c, between(c, a)});
    }
  }
  drop_unused_points(result);
  return result;
}

}  // namespace tunica::geometry
