#include "tunica/geometry/triangle_tree.hpp"

#include <random>

#include "small_surfaces.hpp"
#include "tunica/geometry/nearby_search.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

std::vector<Point> random_points(int count, double extent) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> value(-extent, extent);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back({{value(generator), value(generator), value(generator)}});
  return points;
}

TEST(TriangleTree, FindsTheNearestPointOfAllTriangles) {
  const auto surface = tube(1.0, 2.0, 16, 8);
  const TriangleTree tree(surface);
  for (const auto& x : random_points(200, 2.0)) {
    double best = 1e9;
    for (const auto& t : surface.triangles) {
      const auto on = nearest_on_triangle(x, surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
      best = std::min(best, norm(x - on.place));
    }
    const auto found = tree.nearest(x);
    EXPECT_NEAR(found.distance, best, 1e-12);
    EXPECT_NEAR(norm(found.place - x), best, 1e-12);
    EXPECT_FALSE(tree.nearest(x, 0.99 * best));
  }
}

TEST(NearbySearch, FindsWhatTheTreeFindsWhateverIsKnown) {
  const TriangleTree tree(tube(1.0, 2.0, 16, 8));
  std::int64_t near = -1;
  for (const auto& x : random_points(200, 2.0)) {
    const double distance = tree.nearest(x).distance;
    // The triangle found last is near some of these places and far from others.
    const auto found = nearest_from(tree, x, near);
    EXPECT_NEAR(found.distance, distance, 1e-12);
    EXPECT_EQ(found.triangle, near);
    const auto before = near;
    EXPECT_NEAR(nearest_from(tree, x, near, 1.01 * distance).distance, distance, 1e-12);
    EXPECT_FALSE(nearest_from(tree, x, near, 0.99 * distance));
    EXPECT_EQ(near, -1);
    near = before;
  }
}

TEST(TriangleTree, NearestOnTriangleIsBestAmongItsPoints) {
  const Point a{{0, 0, 0}}, b{{1, 0, 0}}, c{{0.2, 0.8, 0.1}};
  for (const auto& x : random_points(100, 1.5)) {
    const auto found = nearest_on_triangle(x, a, b, c);
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(found.barycentric[i], -1e-12);
      sum += found.barycentric[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    for (double u = 0; u <= 1; u += 0.05)
      for (double v = 0; u + v <= 1; v += 0.05)
        EXPECT_LE(found.distance, norm(x - (u * a + v * b + (1 - u - v) * c)) + 1e-12);
  }
}

TEST(TriangleTree, ConditionPassesOverNearerTriangles) {
  const TriangleTree tree(tube(1.0, 2.0, 32, 8));
  // From inside, only triangles that face away from the x axis: the far side.
  const auto found =
      tree.nearest_if({{0.5, 0, 1}}, 10, [&](const SurfacePoint& q) { return tree.normal(q.triangle)[0] < -0.995; });
  EXPECT_NEAR(found.distance, 1.5, 0.01);
}

TEST(TriangleTree, TellsInsideFromOutside) {
  // A sharp tip is the nearest point of many places: the normal of one of its triangles would not tell.
  const TriangleTree cone({{{{0, 0, 0}}, {{1, 0, 0.3}}, {{1, 0.3, -0.15}}, {{1, -0.3, -0.15}}},
                           {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}});
  EXPECT_GT(enclosed_volume(cone.surface()), 0);
  for (const auto& x : random_points(300, 0.4))
    if (x[0] < -0.1) {
      EXPECT_FALSE(cone.contains(x));
    }
  EXPECT_TRUE(cone.contains({{0.8, 0, 0}}));
  const TriangleTree tree(contour({{1.5, 1.5, 1.5}}, 0.1, [](const Point& x) { return norm(x) - 1; }));
  for (const auto& x : random_points(300, 1.4))
    if (std::abs(norm(x) - 1) > 0.02) {
      EXPECT_EQ(tree.contains(x), norm(x) < 1);
    }
}

TEST(TriangleTree, OffsetCountsTheReach) {
  auto surface = tube(1.0, 2.0, 64, 8);
  std::vector<double> reach;
  for (const auto& p : surface.points) reach.push_back(p[2] > 1 ? 0.5 : 0.1);
  const TriangleTree tree(surface, reach);
  EXPECT_NEAR(tree.offset({{2, 0, 1.8}}, 10).distance, 0.5, 2e-3);
  EXPECT_NEAR(tree.offset({{2, 0, 0.2}}, 10).distance, std::hypot(1, 1.05) - 0.5, 0.06);  // the thick part is nearer
  EXPECT_FALSE(tree.offset({{2, 0, 1.8}}, 0.4));
}

}  // namespace
}  // namespace tunica::geometry
