#include "tunica/stages/meshing/wall_growth.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/stages/meshing/contour.hpp"
#include "tunica/stages/meshing/plane_cut.hpp"
#include "tunica/stages/meshing/triangle_tree.hpp"

namespace tunica::stages::meshing {

namespace {

/// Radius of the largest ball that touches the surface at `x` from inside (shrinking ball, Ma et al. 2012).
double inscribed_radius(const TriangleTree& tree, const Point& x, const Vec3<double>& outward, double largest) {
  double radius = largest;
  for (int i = 0; i < 20; ++i) {
    const Point centre = x - radius * outward;
    const auto q = tree.nearest(centre, radius * (1 - 1e-3));
    if (!q) break;
    const auto to_q = q.place - x;
    // Close beside x it is roughness of the surface, not the other side of the vessel.
    const double depth = -dot(to_q, outward);
    if (depth < 0.3 * norm(to_q)) break;
    radius = dot(to_q, to_q) / (2 * depth);
  }
  return radius;
}

/// Averages over neighbours; the thickness of a wall has no steps.
void smooth(const TriangleSurface& surface, int sweeps, std::vector<double>& values) {
  const auto all = edges(surface);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    auto sum = values;
    std::vector<double> count(values.size(), 1);
    for (const auto& edge : all) {
      sum[edge.a] += values[edge.b];
      sum[edge.b] += values[edge.a];
      ++count[edge.a];
      ++count[edge.b];
    }
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = sum[p] / count[p];
  }
}

/// The lumen made longer at each opening and closed there, so that the wall goes on beyond the plane in which it is
/// cut.
struct Body {
  TriangleSurface surface;
  std::vector<double> thickness;
};

Body lengthened(const TriangleSurface& lumen, const std::vector<double>& thickness,
                const std::vector<Opening>& openings, double spacing) {
  Body body{lumen, thickness};
  auto& [points, triangles] = body.surface;
  for (const auto& opening : openings) {
    const auto& rim = opening.lumen;
    double longest = 0;
    for (const auto p : rim) longest = std::max(longest, thickness[p]);
    const double length = 2 * longest + 4 * spacing;
    const auto first = std::ssize(points), n = std::ssize(rim);
    Point end{{0, 0, 0}};
    for (const auto p : rim) {
      points.push_back(points[p] + length * opening.normal);
      end = end + (1.0 / static_cast<double>(n)) * points.back();
      body.thickness.push_back(thickness[p]);
    }
    points.push_back(end);
    body.thickness.push_back(longest);
    for (std::int64_t i = 0; i < n; ++i) {
      const auto j = (i + 1) % n;
      triangles.push_back({rim[j], rim[i], first + i});
      triangles.push_back({rim[j], first + i, first + j});
      triangles.push_back({first + j, first + i, first + n});
    }
  }
  return body;
}

/// Distance to the body less the thickness.
class WallFunction {
 public:
  explicit WallFunction(Body body) : tree_(std::move(body.surface), body.thickness) {
    const auto [least, most] = std::minmax_element(body.thickness.begin(), body.thickness.end());
    least_ = *least;
    reach_ = *most;
  }
  const TriangleTree& tree() const { return tree_; }
  double reach() const { return reach_; }

  /// Exact within `band` of the value zero outside the body, elsewhere of the right sign.
  double operator()(const Point& x, double band) const {
    const auto nearest = tree_.nearest(x);
    if (tree_.is_behind(x, nearest)) return -nearest.distance - least_;
    if (nearest.distance - reach_ > band) return nearest.distance - reach_;
    if (nearest.distance - least_ < -band) return nearest.distance - least_;
    return tree_.offset(x, nearest.distance).distance;
  }

  /// Moves a point near the outer surface onto it along `n`, at most by `step`. Not straight to the exact place: in
  /// the notch between two vessels neighbours would pass each other.
  Point settle(const Point& x, const Vec3<double>& n, double step) const {
    const auto q = tree_.offset(x, 10 * reach_);
    const auto out = x - q.place;
    const double slope = q ? dot(out, n) / norm(out) : 0;
    return slope > 0.5 ? x - std::clamp(q.distance / slope, -step, step) * n : x;
  }

 private:
  TriangleTree tree_;
  double least_ = 0, reach_ = 0;  ///< smallest and largest thickness
};

Grid grid_around(const TriangleSurface& surface, double margin, double spacing) {
  Point low = surface.points[0], high = low;
  for (const auto& p : surface.points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  Grid grid{low - Vec3<double>{{margin, margin, margin}}, spacing, {}, {}};
  for (int d = 0; d < 3; ++d) grid.size[d] = static_cast<std::int64_t>((high[d] - low[d] + 2 * margin) / spacing) + 2;
  return grid;
}

Grid sample(const WallFunction& wall, double spacing) {
  const auto& body = wall.tree().surface();
  const double band = wall.reach() + 2 * spacing;
  auto grid = grid_around(body, band + 2 * spacing, spacing);
  grid.values.assign(grid.size[0] * grid.size[1] * grid.size[2], 0);
  std::vector<bool> due(grid.values.size(), false);
  for (const auto& t : body.triangles) {
    std::int64_t low[3], high[3];
    for (int d = 0; d < 3; ++d) {
      const auto [a, b] = std::minmax({body.points[t[0]][d], body.points[t[1]][d], body.points[t[2]][d]});
      low[d] = std::max<std::int64_t>(0, std::llround((a - band - grid.origin[d]) / spacing));
      high[d] =
          std::min(grid.size[d] - 1, static_cast<std::int64_t>(std::llround((b + band - grid.origin[d]) / spacing)));
    }
    for (auto k = low[2]; k <= high[2]; ++k)
      for (auto j = low[1]; j <= high[1]; ++j)
        for (auto i = low[0]; i <= high[0]; ++i) due[grid.index(i, j, k)] = true;
  }
  // The band has no gaps, so along a row the sign changes only inside it.
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      double side = 1;
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const auto at = grid.index(i, j, k);
        const double value = due[at] ? wall(grid.place(i, j, k), 2 * spacing) : side * band;
        grid.values[at] = static_cast<float>(value);
        side = value < 0 ? -1 : 1;
      }
    }
  return grid;
}

/// Drops the parts that enclose cavities: their normals point inward, to the positive side.
TriangleSurface without_cavities(const TriangleSurface& surface) {
  const auto part = components(surface);
  std::map<std::int64_t, TriangleSurface> parts;
  for (std::size_t t = 0; t < part.size(); ++t) parts[part[t]].triangles.push_back(surface.triangles[t]);
  TriangleSurface result;
  for (auto& [number, one] : parts) {
    one.points = surface.points;
    drop_unused_points(one);
    if (enclosed_volume(one) > 0) append(result, one);
  }
  return result;
}

double rim_radius(const TriangleSurface& lumen, const Opening& opening) {
  double radius = 0;
  for (const auto p : opening.lumen) radius = std::max(radius, norm(lumen.points[p] - opening.centre));
  return radius;
}

}  // namespace

std::vector<double> thickness_by_radius(const TriangleSurface& lumen, const std::vector<Opening>& openings,
                                        const GrowthSettings& settings) {
  const std::vector<double> uniform(lumen.points.size(), settings.thickest);
  if (settings.thinnest == settings.thickest) return uniform;
  const auto outer = grow_wall(lumen, uniform, openings, 2 * settings.spacing);
  const auto normals = point_normals(outer);
  const TriangleTree tree(outer);
  const double largest = settings.thickest / settings.per_radius + settings.thickest;
  std::vector<double> radii;
  for (std::size_t p = 0; p < outer.points.size(); ++p)
    radii.push_back(inscribed_radius(tree, outer.points[p], normals[p], largest) - settings.thickest);
  std::vector<double> result;
  for (const auto& x : lumen.points) {
    const double radius = tree.interpolate(radii, tree.nearest(x));
    result.push_back(std::clamp(settings.per_radius * radius, settings.thinnest, settings.thickest));
  }
  smooth(lumen, 5, result);
  return result;
}

TriangleSurface grow_wall(const TriangleSurface& lumen, const std::vector<double>& thickness,
                          const std::vector<Opening>& openings, double spacing) {
  const WallFunction wall(lengthened(lumen, thickness, openings, spacing));
  auto outer = without_cavities(zero_surface(sample(wall, spacing)));
  const auto normals = point_normals(outer);
  for (std::size_t p = 0; p < outer.points.size(); ++p)
    outer.points[p] = wall.settle(outer.points[p], normals[p], 0.3 * spacing);
  for (const auto& opening : openings)
    outer = cut_end(outer, {opening.centre, opening.normal, rim_radius(lumen, opening) + wall.reach() + 3 * spacing});
  return outer;
}

}  // namespace tunica::stages::meshing
