#include "tunica/mesh/slab.hpp"

#include <cmath>
#include <numbers>

#include "tunica/base/error.hpp"
#include "tunica/mesh/blocks.hpp"

namespace tunica::mesh {

namespace {

using section::Blocks;
using section::graded;
using section::Index;
using section::Point;
using section::require_size;

/// Lines of the blocks: a square around the cylinder is left to rings of cells, all else is a grid.
struct FlagGrid {
  std::vector<double> before, square, along_flag, behind;             ///< x
  std::vector<double> low, below_flag, flag, above_flag, high, left;  ///< y; `left`: the square's side
  std::vector<Point> outer;  ///< of the rings, from the flag's upper side counter-clockwise to its lower side
  double first_angle;        ///< of the flag's upper corner on the cylinder
  int rings;
};

FlagGrid flag_grid(const FlagSizes& z) {
  const int r = z.refinement;
  const double side = 2.0 * z.radius, half = 0.5 * z.flag_thickness;
  FlagGrid g;
  g.first_angle = std::asin(half / z.radius);
  g.rings = 4 * r;
  g.before = graded(0, z.x - side, 3 * r);
  g.square = graded(z.x - side, z.x + side, 8 * r);
  g.along_flag = graded(z.x + side, z.tip, 12 * r, 0.5);
  g.behind = graded(z.tip, z.length, 16 * r, 25.0);
  g.low = graded(0, z.y - side, 4 * r, 2.0);
  g.below_flag = graded(z.y - side, z.y - half, 4 * r, 0.35);
  g.flag = graded(z.y - half, z.y + half, 2 * r);
  g.above_flag = graded(z.y + half, z.y + side, 4 * r, 1 / 0.35);
  g.high = graded(z.y + side, z.height, 4 * r, 0.5);
  g.left = graded(z.y - side, z.y + side, 8 * r);
  for (const double y : g.above_flag) g.outer.push_back({g.square.back(), y});
  for (auto k = g.square.size() - 1; k-- > 0;) g.outer.push_back({g.square[k], g.left.back()});
  for (auto k = g.left.size() - 1; k-- > 0;) g.outer.push_back({g.square.front(), g.left[k]});
  for (std::size_t k = 1; k < g.square.size(); ++k) g.outer.push_back({g.square[k], g.left.front()});
  for (std::size_t k = 1; k < g.below_flag.size(); ++k) g.outer.push_back({g.square.back(), g.below_flag[k]});
  return g;
}

/// Point of the rings on ray `k` at the distance `t` of 0 (cylinder) to 1 (square).
Point ring_point(const FlagSizes& z, const FlagGrid& g, std::size_t k, double t) {
  const double last = static_cast<double>(g.outer.size() - 1), part = static_cast<double>(k) / last;
  const double angle = g.first_angle + 2 * (std::numbers::pi - g.first_angle) * part;
  Point on_cylinder{z.x + z.radius * std::cos(angle), z.y + z.radius * std::sin(angle)};
  if (k == 0) on_cylinder[1] = g.outer.front()[1];
  if (k == g.outer.size() - 1) on_cylinder[1] = g.outer.back()[1];
  if (t == 1.0) return g.outer[k];
  const auto between = [&](std::size_t c) {
    return on_cylinder[c] == g.outer[k][c] ? on_cylinder[c] : (1 - t) * on_cylinder[c] + t * g.outer[k][c];
  };
  return {between(0), between(1)};
}

bool on_cylinder(const FlagSizes& z, const Point& p) {
  return std::abs(std::hypot(p[0] - z.x, p[1] - z.y) - z.radius) < 1e-9 * z.radius;
}

section::Section lumen_section(const FlagSizes& z, const FlagGrid& g, const std::vector<double>& radial) {
  Blocks blocks;
  const auto join = [](std::vector<double> a, const std::vector<double>& b) {
    a.insert(a.end(), b.begin() + 1, b.end());
    return a;
  };
  blocks.add(join(g.before, g.square), g.low);
  blocks.add(join(g.before, g.square), g.high);
  blocks.add(g.before, g.left);
  const auto right = join(g.along_flag, g.behind);
  for (const auto* y : {&g.low, &g.below_flag, &g.above_flag, &g.high}) blocks.add(right, *y);
  blocks.add(g.behind, g.flag);
  blocks.add(static_cast<int>(g.outer.size()) - 1, g.rings, [&](int k, int j) {  // outward and clockwise is mirrored
    return ring_point(z, g, g.outer.size() - 1 - static_cast<std::size_t>(k), radial[static_cast<std::size_t>(j)]);
  });
  return blocks.finish(
      [&](const Point& a, const Point& b) -> std::string {
        if (a[0] == 0 && b[0] == 0) return "inlet";
        if (a[0] == z.length && b[0] == z.length) return "outlet";
        if ((a[1] == 0 && b[1] == 0) || (a[1] == z.height && b[1] == z.height)) return "channel";
        return on_cylinder(z, a) && on_cylinder(z, b) ? "cylinder" : "flag_lumen";
      },
      z.y);
}

/// Within the square the flag's cells follow the first ring of both sides, and the arc of the cylinder.
section::Section flag_section(const FlagSizes& z, const FlagGrid& g, const std::vector<double>& radial) {
  Blocks blocks;
  const auto rows = g.flag.size() - 1;
  blocks.add(g.rings, static_cast<int>(rows), [&](int i, int j) {
    const double t = radial[static_cast<std::size_t>(i)], y = g.flag[static_cast<std::size_t>(j)];
    if (j == 0) return ring_point(z, g, g.outer.size() - 1, t);
    if (j == static_cast<int>(rows)) return ring_point(z, g, 0, t);
    const double x = z.x + std::sqrt(z.radius * z.radius - (y - z.y) * (y - z.y));
    return t == 1.0 ? Point{g.square.back(), y} : Point{(1 - t) * x + t * g.square.back(), y};
  });
  blocks.add(g.along_flag, g.flag);
  return blocks.finish(
      [&](const Point& a, const Point& b) -> std::string {
        return on_cylinder(z, a) && on_cylinder(z, b) ? "flag_root" : "flag_wall";
      },
      z.y);
}

/// Nodes of the wall that lie where a node of the lumen does. Both were made by the same arithmetic.
void pair_twins(MeshData& mesh, Index lumen_nodes) {
  std::map<std::array<double, 3>, Index> lumen;
  for (Index i = 0; i < std::ssize(mesh.points); ++i) {
    const auto& x = mesh.points[static_cast<std::size_t>(i)];
    const std::array<double, 3> place{x[0], x[1], x[2]};
    if (i < lumen_nodes)
      lumen[place] = i;
    else if (const auto host = lumen.find(place); host != lumen.end())
      mesh.twins.emplace_back(i, host->second);
  }
}

}  // namespace

MeshData flag_behind_cylinder(const FlagSizes& z) {
  require_size(z.refinement >= 1 && z.layers >= 1, "flag", "the numbers of cells must be at least 1");
  require_size(z.depth > 0 && z.radius > 0 && z.flag_thickness > 0 && z.flag_thickness < 2 * z.radius, "flag",
               "the sizes must be positive, and the flag thinner than the cylinder");
  const double side = 2 * z.radius;
  require_size(z.x - side > 0 && z.x + side < z.tip && z.tip < z.length && z.y - side > 0 && z.y + side < z.height,
               "flag", "a square of twice the cylinder's diameter and the flag have to fit into the channel");
  const FlagGrid g = flag_grid(z);
  const auto radial = graded(0, 1, g.rings, 2.0);
  MeshData mesh;
  section::extrude(mesh, lumen_section(z, g, radial), z.depth, z.layers, "lumen", RegionKind::lumen, "side_low",
                   "side_high");
  const Index lumen_nodes = std::ssize(mesh.points);
  section::extrude(mesh, flag_section(z, g, radial), z.depth, z.layers, "flag", RegionKind::wall, "flag_low",
                   "flag_high");
  pair_twins(mesh, lumen_nodes);
  return mesh;
}

MeshData backward_step(const StepSizes& z) {
  require_size(z.cells_across >= 2 && z.cells_across % 2 == 0 && z.cells_along >= 1, "step",
               "the numbers of cells must be at least 1, and even across");
  require_size(z.length > 0 && z.height > 0 && z.depth > 0, "step", "the sizes must be positive");
  Blocks blocks;
  const double half = 0.5 * z.height;
  const auto x = graded(0, z.length, z.cells_along, 4.0);
  blocks.add(x, graded(-half, 0, z.cells_across / 2));
  blocks.add(x, graded(0, half, z.cells_across / 2));
  const auto s = blocks.finish([&](const Point& a, const Point& b) -> std::string {
    if (a[0] == z.length && b[0] == z.length) return "outlet";
    if (a[0] == 0 && b[0] == 0 && a[1] + b[1] > 0) return "inlet";
    return a[1] == half && b[1] == half ? "wall_high" : "wall_low";
  });
  MeshData mesh;
  section::extrude(mesh, s, z.depth, 1, "lumen", RegionKind::lumen, "side_low", "side_high");
  return mesh;
}

}  // namespace tunica::mesh
