#include "tunica/geometry/elements_across.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/base/limits.hpp"
#include "tunica/geometry/size_field.hpp"

namespace tunica::geometry {

namespace {

using base::infinity;
constexpr double widest_vessel = 0.1;  // m: no vessel is wider

/// Where the wall is nearest to a node, and which way that is.
struct Nearest {
  Vec3<double> direction{{0, 0, 0}};  ///< unit; zero where unknown
  double diameter = infinity;
  std::int64_t triangle = -1, facing = -1;
};

/// Mean of the corners that have a diameter, by their share in the place.
double diameter_at(const TriangleTree& wall, const std::vector<double>& diameter, const SurfacePoint& at) {
  double sum = 0, shares = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = diameter[wall.surface().triangles[at.triangle][i]];
    if (!std::isfinite(d)) continue;
    sum += at.barycentric[i] * d;
    shares += at.barycentric[i];
  }
  return shares > 1e-6 ? sum / shares : infinity;
}

Nearest nearest(const TriangleTree& wall, const LumenDiameter& diameter, const Vec3<double>& normal, const Point& x) {
  const auto at = wall.nearest(x);
  Nearest result;
  if (!at) return result;
  result.triangle = at.triangle;
  result.diameter = diameter_at(wall, diameter.value, at);
  const auto nearest_corner = std::max_element(at.barycentric.x, at.barycentric.x + 3) - at.barycentric.x;
  result.facing = diameter.facing[wall.surface().triangles[at.triangle][nearest_corner]];
  // On the wall itself its normal is the direction.
  if (norm(normal) > 0)
    result.direction = normal;
  else if (at.distance > 0)
    result.direction = (1 / at.distance) * (x - at.place);
  return result;
}

}  // namespace

ElementsAcross elements_across(const std::vector<Point>& points, std::span<const std::array<std::int64_t, 4>> elements,
                               std::vector<Triangle> wall) {
  const auto n = points.size();
  ElementsAcross result{std::vector<double>(n, infinity), std::vector<double>(n, infinity), std::vector<double>(n, 0.0),
                        std::vector<std::int64_t>(n, -1), std::vector<std::int64_t>(n, -1)};
  for (const auto& t : elements) {
    const auto& a = points[t[0]];
    const double volume = dot(points[t[1]] - a, cross(points[t[2]] - a, points[t[3]] - a)) / 6;
    for (const auto node : t) result.volume[node] += 0.25 * volume;
  }
  const TriangleTree tree({points, std::move(wall)});
  const auto diameter = lumen_diameter(tree, widest_vessel);
  const auto normals = point_normals(tree.surface());
  std::vector<Vec3<double>> direction(n, {{0, 0, 0}});
  for (std::size_t p = 0; p < n; ++p) {
    if (result.volume[p] <= 0) continue;
    const auto found = nearest(tree, diameter, normals[p], points[p]);
    direction[p] = found.direction;
    result.diameter[p] = found.diameter;
    result.facing[p] = found.facing;
    result.wall[p] = found.triangle;
  }
  std::vector<double> extent(n, 0.0), edges(n, 0.0);
  for (const auto& t : elements)
    for (const auto node : t)
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) {
          extent[node] += 2 * std::abs(dot(direction[node], points[t[a]] - points[t[b]]));
          edges[node] += 1;
        }
  for (std::size_t p = 0; p < n; ++p)
    if (extent[p] > 0) result.count[p] = result.diameter[p] * edges[p] / extent[p];
  return result;
}

std::optional<AcrossPart> across_part(const std::string& name, const std::vector<Point>& points,
                                      const ElementsAcross& across, const std::function<bool(std::int64_t)>& belongs) {
  std::vector<std::int64_t> nodes;
  double all = 0;
  for (std::int64_t p = 0; p < std::ssize(points); ++p)
    if (std::isfinite(across.count[p]) && belongs(p)) {
      nodes.push_back(p);
      all += across.volume[p];
    }
  if (nodes.empty()) return std::nullopt;
  std::sort(nodes.begin(), nodes.end(), [&](auto a, auto b) { return across.count[a] < across.count[b]; });
  const auto below = [&](double share) {
    double sum = 0;
    for (const auto p : nodes)
      if ((sum += across.volume[p]) >= share * all) return p;
    return nodes.back();
  };
  const auto least = below(0.05);
  return AcrossPart{name, across.count[least], across.count[below(0.5)], across.diameter[least], points[least]};
}

std::optional<std::string> too_few_across(const std::vector<AcrossPart>& parts, double enough) {
  std::vector<const AcrossPart*> few;
  for (const auto& part : parts)
    if (part.median < 0.9 * enough || part.least < enough / 1.5) few.push_back(&part);
  if (few.empty()) return std::nullopt;
  std::sort(few.begin(), few.end(), [](const auto* a, const auto* b) { return a->least < b->least; });
  constexpr std::size_t named = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(named, few.size()); ++i)
    names += fmt::format("{}{} {:.1f} ({:.1f} mm wide near {})", i == 0 ? "" : ", ", few[i]->name, few[i]->least,
                         1e3 * few[i]->diameter, list_places_mm(std::span(&few[i]->place, 1)));
  if (few.size() > named) names += fmt::format(" and {} more parts", few.size() - named);
  return fmt::format("fewer elements across than the {:g} that flow needs: {}", enough, names);
}

}  // namespace tunica::geometry
