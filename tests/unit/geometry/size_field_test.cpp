#include "tunica/geometry/size_field.hpp"

#include "small_surfaces.hpp"
#include "tunica/geometry/remesh.hpp"

namespace tunica::geometry {
namespace {

using namespace test;

TEST(WallThickness, MeasuredToTheOuterSurface) {
  const TriangleTree lumen(tube(5e-3, 20e-3, 60, 30)), outer(tube(6.5e-3, 20e-3, 60, 30));
  const auto thickness = wall_thickness(lumen, &outer, 5e-3);
  for (std::size_t p = 0; p < thickness.value.size(); ++p) {
    EXPECT_NEAR(thickness.value[p], 1.5e-3, 0.02e-3);
    EXPECT_EQ(thickness.flap[p], 0);
  }
  for (const auto t : wall_thickness(lumen, &outer, 1e-3).value) EXPECT_TRUE(std::isinf(t));
}

TEST(WallThickness, TellsFlapFromWall) {
  const TriangleTree lumen(dissected_tube()), outer(tube(12e-3, 80e-3, 60, 30));
  auto around = outer.surface();
  for (auto& p : around.points) p[2] -= 40e-3;
  const TriangleTree wall(around);
  const auto thickness = wall_thickness(lumen, &wall, 5e-3);
  const auto& points = lumen.surface().points;
  int flap = 0, outside = 0, tip = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    // At the rim of the flap the sides beside it are near, but nothing faces it.
    if (std::abs(points[p][2]) > 14.9e-3 && std::hypot(points[p][0], points[p][1]) < 5e-3 &&
        std::abs(points[p][2]) < 16e-3) {
      EXPECT_TRUE(std::isinf(thickness.value[p]));
      ++tip;
    }
    if (std::abs(points[p][2]) > 12e-3) continue;
    if (std::abs(points[p][0]) < 1.1e-3 && std::abs(points[p][1]) < 6e-3) {
      EXPECT_EQ(thickness.flap[p], 1);
      EXPECT_NEAR(thickness.value[p], 2e-3, 0.02e-3);
      ++flap;
    } else if (std::abs(points[p][0]) > 3e-3) {
      EXPECT_EQ(thickness.flap[p], 0);
      EXPECT_NEAR(thickness.value[p], 2e-3, 0.1e-3);
      ++outside;
    }
  }
  EXPECT_GT(flap, 100);
  EXPECT_GT(outside, 100);
  EXPECT_GT(tip, 5);
}

TEST(CurvatureRadius, OfATubeAndABall) {
  const auto round = curvature_radius(tube(5e-3, 20e-3, 60, 30));
  EXPECT_NEAR(round[15 * 60], 5e-3, 0.5e-3);
  const auto rough = contour({{6e-3, 6e-3, 6e-3}}, 0.4e-3, [](const Point& x) { return norm(x) - 5e-3; });
  const std::vector<double> sizes(rough.points.size(), 0.6e-3);
  const auto ball = remesh({rough, {}}, {TriangleTree(rough), {}, sizes}).surface;
  double mean = 0;
  for (const auto r : curvature_radius(ball)) mean += r / static_cast<double>(ball.points.size());
  EXPECT_NEAR(mean, 5e-3, 0.5e-3);
}

TEST(SurfaceSizes, BoundedAndGraded) {
  const auto surface = tube(5e-3, 20e-3, 60, 30);
  std::vector<double> thickness(surface.points.size(), 1.0);
  thickness[0] = 0.1e-3;
  SizeSettings settings;
  settings.largest = 1.5e-3;
  settings.smallest = 0.3e-3;
  const auto sizes = surface_sizes(surface, thickness, {}, settings);
  EXPECT_DOUBLE_EQ(sizes[0], 0.3e-3);
  EXPECT_DOUBLE_EQ(sizes[25 * 60], 1.5e-3);
  for (const auto& e : edges(surface))
    EXPECT_LE(std::abs(sizes[e.a] - sizes[e.b]), 0.3 * norm(surface.points[e.a] - surface.points[e.b]) + 1e-12);
}

TEST(SizeField, GrowsWithTheDistance) {
  const auto surface = tube(5e-3, 20e-3, 60, 30);
  const SizeField field(surface, std::vector<double>(surface.points.size(), 0.5e-3), 0.3, 1e-3);
  EXPECT_NEAR(field({{5e-3, 0, 10e-3}}), 0.5e-3, 1e-5);
  EXPECT_NEAR(field({{4e-3, 0, 10e-3}}), 0.8e-3, 1e-5);
  EXPECT_DOUBLE_EQ(field({{0, 0, 10e-3}}), 1e-3);
}

}  // namespace
}  // namespace tunica::geometry
