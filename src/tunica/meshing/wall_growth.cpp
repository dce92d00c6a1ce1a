#include "tunica/meshing/wall_growth.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/geometry/contour.hpp"
#include "tunica/geometry/nearby_search.hpp"
#include "tunica/geometry/plane_cut.hpp"
#include "tunica/geometry/remesh.hpp"
#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::meshing {

namespace {

/// Radius of the largest ball that touches the surface at `x` from inside (shrinking ball, Ma et al. 2012), moved away
/// from the surface while that lets it grow: the normal at `x` only roughly points to the axis of the vessel.
double inscribed_radius(const geometry::TriangleTree& tree, const geometry::Point& x, const Vec3<double>& outward,
                        double largest) {
  double radius = largest;
  for (int i = 0; i < 20; ++i) {
    const geometry::Point centre = x - radius * outward;
    const auto q = tree.nearest(centre, radius * (1 - 1e-3));
    if (!q) break;
    const auto to_q = q.place - x;
    // Close beside x it is roughness of the surface, not the other side of the vessel.
    const double depth = -dot(to_q, outward);
    if (depth < 0.3 * norm(to_q)) break;
    radius = dot(to_q, to_q) / (2 * depth);
  }
  if (radius >= largest) return largest;
  geometry::Point centre = x - radius * outward;
  std::int64_t near = -1;
  for (int i = 0; i < 8; ++i) {
    const auto q = geometry::nearest_from(tree, centre, near);
    const auto away = centre - q.place;
    const geometry::Point next = centre + 0.05 * away;
    const double there = geometry::nearest_from(tree, next, near).distance;
    radius = std::max(q.distance, there);
    if (there <= q.distance) break;
    centre = next;
  }
  return std::min(radius, largest);
}

/// The lumen made longer at each opening and closed there, so that the wall goes on beyond the plane in which it is
/// cut.
struct Body {
  geometry::TriangleSurface surface;
  std::vector<double> thickness;
};

Body lengthened(const geometry::TriangleSurface& lumen, const std::vector<double>& thickness,
                const std::vector<geometry::Opening>& openings, double margin) {
  Body body{lumen, thickness};
  auto& [points, triangles] = body.surface;
  for (const auto& opening : openings) {
    const auto& rim = opening.lumen;
    double longest = 0;
    for (const auto p : rim) longest = std::max(longest, thickness[p]);
    const double length = 2 * longest + margin;
    const auto first = std::ssize(points), n = std::ssize(rim);
    geometry::Point end{{0, 0, 0}};
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
  const geometry::TriangleTree& tree() const { return tree_; }
  double reach() const { return reach_; }

  /// Exact within `band` of the value zero outside the body, elsewhere of the right sign. `near`: the triangle found at
  /// a place beside x, or -1; becomes the one found here.
  double operator()(const geometry::Point& x, double band, std::int64_t& near) const {
    const auto nearest = geometry::nearest_from(tree_, x, near);
    if (tree_.is_behind(x, nearest)) return -nearest.distance - least_;
    if (nearest.distance - reach_ > band) return nearest.distance - reach_;
    if (nearest.distance - least_ < -band) return nearest.distance - least_;
    return tree_.offset(x, nearest.distance).distance;
  }

 private:
  geometry::TriangleTree tree_;
  double least_ = 0, reach_ = 0;  ///< smallest and largest thickness
};

geometry::Grid grid_around(const geometry::TriangleSurface& surface, double margin, double spacing) {
  geometry::Point low = surface.points[0], high = low;
  for (const auto& p : surface.points)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  geometry::Grid grid{low - Vec3<double>{{margin, margin, margin}}, spacing, {}, {}};
  for (int d = 0; d < 3; ++d) grid.size[d] = static_cast<std::int64_t>((high[d] - low[d] + 2 * margin) / spacing) + 2;
  return grid;
}

/// Calls `visit(index, place)` for all samples, x fastest.
template <class Visit>
void for_each_place(const geometry::Grid& grid, Visit visit) {
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) visit(grid.index(i, j, k), grid.place(i, j, k));
}

/// Distance less thickness and `level`, exact within two grid steps of zero. Farther away only its sign matters, and
/// the value, which changes no faster than the place, says for which blocks of samples one of them stands.
class Sampling {
 public:
  Sampling(const WallFunction& wall, double level, double spacing)
      : wall_(wall),
        level_(level),
        exact_(2 * spacing),
        grid_(grid_around(wall.tree().surface(), wall.reach() + level + 2 * exact_, spacing)) {
    grid_.values.resize(grid_.size[0] * grid_.size[1] * grid_.size[2]);
    for (std::int64_t k = 0; k < grid_.size[2]; k += largest_block)
      for (std::int64_t j = 0; j < grid_.size[1]; j += largest_block)
        for (std::int64_t i = 0; i < grid_.size[0]; i += largest_block) fill({i, j, k}, largest_block);
  }
  geometry::Grid take() { return std::move(grid_); }

 private:
  using Corner = std::array<std::int64_t, 3>;
  static constexpr std::int64_t largest_block = 16;

  void fill(const Corner& first, std::int64_t side) {
    for (int d = 0; d < 3; ++d)
      if (first[d] >= grid_.size[d]) return;
    Corner middle = first;
    for (int d = 0; d < 3; ++d) middle[d] = std::min(first[d] + side / 2, grid_.size[d] - 1);
    const double value = wall_(grid_.place(middle[0], middle[1], middle[2]), level_ + exact_, near_) - level_;
    const double farthest = std::sqrt(3.0) * static_cast<double>(side / 2) * grid_.spacing;
    if (side > 1 && std::abs(value) - exact_ < farthest) {
      for (int part = 0; part < 8; ++part)
        fill({first[0] + (part & 1) * side / 2, first[1] + (part >> 1 & 1) * side / 2,
              first[2] + (part >> 2) * side / 2},
             side / 2);
      return;
    }
    for (auto k = first[2]; k < std::min(first[2] + side, grid_.size[2]); ++k)
      for (auto j = first[1]; j < std::min(first[1] + side, grid_.size[1]); ++j)
        for (auto i = first[0]; i < std::min(first[0] + side, grid_.size[0]); ++i)
          grid_.values[grid_.index(i, j, k)] = static_cast<float>(value);
  }

  const WallFunction& wall_;
  double level_, exact_;
  geometry::Grid grid_;
  std::int64_t near_ = -1;  ///< triangle found at the place before
};

/// Turns samples of the distance to a surface `depth` outside the wanted one into samples of that distance to the
/// wanted one: `outside` is the surface, and what lies deeper than `depth` below it is inside.
void erode(const geometry::TriangleTree& outside, double depth, geometry::Grid& grid) {
  const double band = 2 * grid.spacing;
  std::int64_t near = -1;
  for_each_place(grid, [&](std::int64_t at, const geometry::Point& x) {
    auto& value = grid.values[at];
    if (value >= 0) {
      value = static_cast<float>(depth);
    } else if (value < -depth - band) {
      value = static_cast<float>(-band);
    } else {
      const double distance = geometry::nearest_from(outside, x, near, depth + band).distance;
      value = static_cast<float>(depth - std::min(depth + band, distance));
    }
  });
}

/// Drops the parts that enclose cavities: their normals point inward, to the positive side.
geometry::TriangleSurface without_cavities(const geometry::TriangleSurface& surface) {
  const auto part = geometry::components(surface);
  std::map<std::int64_t, geometry::TriangleSurface> parts;
  for (std::size_t t = 0; t < part.size(); ++t) parts[part[t]].triangles.push_back(surface.triangles[t]);
  geometry::TriangleSurface result;
  for (auto& [number, one] : parts) {
    one.points = surface.points;
    geometry::drop_unused_points(one);
    if (geometry::enclosed_volume(one) > 0) geometry::append(result, one);
  }
  return result;
}

double rim_radius(const geometry::TriangleSurface& lumen, const geometry::Opening& opening) {
  double radius = 0;
  for (const auto p : opening.lumen) radius = std::max(radius, norm(lumen.points[p] - opening.centre));
  return radius;
}

}  // namespace

config::Schema<GrowthSettings> GrowthSettings::schema() {
  using G = GrowthSettings;
  using config::Schema;
  return Schema<G>("wall", "The wall that is grown around the lumen, thicker around wider vessels.")
      .number("per_radius", &G::per_radius, config::range(0.02, 1), "Its thickness over the radius of the vessel")
      .by_default()
      .quantity("thinnest", &G::thinnest, config::dimension::length, config::range(0.3e-3, 6e-3), "Lower bound of it")
      .by_default()
      .quantity("thickest", &G::thickest, config::dimension::length, config::range(0.3e-3, 6e-3),
                "Upper bound of it; equal to `thinnest` for the same thickness everywhere")
      .by_default()
      .quantity("fillet", &G::fillet, config::dimension::length, config::range(0.2e-3, 5e-3),
                "Radius by which notches between vessels are rounded")
      .by_default()
      .quantity("true_lumen_wall", &G::true_lumen_wall, config::dimension::length, config::range(0.3e-3, 6e-3),
                "Thickness around the true lumen, instead of the rule")
      .optional()
      .quantity("false_lumen_wall", &G::false_lumen_wall, config::dimension::length, config::range(0.3e-3, 6e-3),
                "Thickness around the false lumen, instead of the rule")
      .optional()
      .quantity("branches", &G::branches, config::dimension::length, config::range(0.3e-3, 6e-3),
                "Thickness around branches, instead of the rule")
      .optional()
      .section("thickness", &G::thickness, ThicknessField::schema(),
               "Thickness as it was measured or painted, instead of all rules where there is one")
      .check([](const G& g, config::Problems& problems) {
        if (g.thinnest > g.thickest)
          problems.add("thinnest", "is larger than `thickest`", "swap them, or give the same thickness twice");
      });
}

std::vector<double> thickness_by_radius(const geometry::TriangleSurface& lumen,
                                        const std::vector<geometry::Opening>& openings,
                                        const GrowthSettings& settings) {
  const std::vector<double> uniform(lumen.points.size(), settings.thickest);
  if (settings.thinnest == settings.thickest) return uniform;
  auto coarse = settings;
  coarse.spacing = 2 * settings.spacing;
  const auto outer = grow_wall(lumen, uniform, openings, coarse);
  const auto normals = geometry::point_normals(outer);
  const geometry::TriangleTree tree(outer);
  const double largest = settings.thickest / settings.per_radius + settings.thickest;
  std::vector<double> radii;
  for (std::size_t p = 0; p < outer.points.size(); ++p)
    radii.push_back(inscribed_radius(tree, outer.points[p], normals[p], largest) - settings.thickest);
  std::vector<double> result;
  for (const auto& x : lumen.points) {
    const double radius = tree.interpolate(radii, tree.nearest(x));
    result.push_back(std::clamp(settings.per_radius * radius, settings.thinnest, settings.thickest));
  }
  geometry::average_over_neighbours(lumen, 5, result);  // the thickness of a wall has no steps
  return result;
}

geometry::TriangleSurface grow_wall(const geometry::TriangleSurface& lumen, const std::vector<double>& thickness,
                                    const std::vector<geometry::Opening>& openings, const GrowthSettings& settings) {
  const double spacing = settings.spacing, fillet = settings.fillet;
  const WallFunction wall(lengthened(lumen, thickness, openings, fillet + 4 * spacing));
  // Closing: grown too far by the radius of the fillets and eroded by it again, the notches between vessels are round.
  auto grid = Sampling(wall, fillet, spacing).take();
  erode(geometry::TriangleTree(without_cavities(geometry::zero_surface(grid))), fillet, grid);
  auto outer = without_cavities(geometry::zero_surface(grid));
  const double beyond = wall.reach() + fillet + 3 * spacing;
  for (const auto& opening : openings)
    outer = geometry::cut_end(outer, {opening.centre, opening.normal, rim_radius(lumen, opening) + beyond});
  // Contours are full of slivers, from which no curvature can be told.
  const std::vector<double> sizes(outer.points.size(), 2 * spacing);
  return geometry::remesh({outer, {}}, {geometry::TriangleTree(outer), {}, sizes}).surface;
}

}  // namespace tunica::meshing
