#include "tunica/meshing/tears.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "block_vessel.hpp"
#include "tunica/meshing/element_cut.hpp"

namespace tunica::meshing {
namespace {

double area(const std::vector<geometry::Point>& polygon) {
  Vec3<double> sum{{0, 0, 0}};
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum = sum + 0.5 * cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return norm(sum);
}

TEST(ZeroPolygon, CutsOfAUnitTetrahedron) {
  const std::array<geometry::Point, 4> corners = {{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}};
  const auto cut = [&](const Vec3<double>& n, double at) {
    std::array<double, 4> values;
    for (int k = 0; k < 4; ++k) values[k] = dot(n, corners[k]) - at;
    return zero_polygon(corners, values);
  };
  EXPECT_EQ(cut({{0, 0, 1}}, 0.5).size(), 3U);
  EXPECT_NEAR(area(cut({{0, 0, 1}}, 0.5)), 0.125, 1e-15);
  EXPECT_NEAR(area(cut({{0, 0, -1}}, -0.5)), 0.125, 1e-15);
  // x + y = 1/2 cuts a rectangle of sides sqrt(2)/2 and 1/2.
  EXPECT_EQ(cut({{1, 1, 0}}, 0.5).size(), 4U);
  EXPECT_NEAR(area(cut({{1, 1, 0}}, 0.5)), std::sqrt(0.5) * 0.5, 1e-15);
  EXPECT_TRUE(cut({{1, 1, 1}}, 2).empty());
}

TEST(FindTears, TheHoleOfTheBlockVessel) {
  const test::BlockVessel vessel;
  const auto mesh = test::block_vessel(vessel);
  // The flap is in the cell from x = 4 to 5 mm; the false lumen is closed by a cell at either end.
  std::vector<double> side;
  for (const auto& p : mesh.points) {
    const bool level = p[2] > (vessel.from + 1) * 1e-3 - 1e-9 && p[2] < (vessel.to - 1) * 1e-3 + 1e-9;
    side.push_back(level ? 4.5e-3 - p[0] : 1e-3);
  }
  const auto tears = find_tears(mesh, side);
  ASSERT_EQ(tears.size(), 1U);
  EXPECT_NEAR(tears[0].area, 4e-6, 1e-12);  // two cells by two
  EXPECT_NEAR(norm(tears[0].centre - geometry::Point{{4.5e-3, 5e-3, 9e-3}}), 0, 1e-9);
  EXPECT_NEAR(tears[0].normal[0], -1, 1e-9);
  EXPECT_TRUE(find_tears(test::block_vessel({.hole = false}), side).empty());
}

TEST(FindTears, TheAreaIsThatOfTheRimHoweverTheSurfaceWithinItBulges) {
  const test::BlockVessel vessel;
  const auto mesh = test::block_vessel(vessel);
  std::vector<double> flat, bulging;
  for (const auto& p : mesh.points) {
    const bool level = p[2] > (vessel.from + 1) * 1e-3 - 1e-9 && p[2] < (vessel.to - 1) * 1e-3 + 1e-9;
    flat.push_back(level ? 4.5e-3 - p[0] : 1e-3);
    // The middle of the hole is moved, its rim is not.
    const bool middle = std::hypot(p[1] - 5e-3, p[2] - 9e-3) < 0.5e-3;
    bulging.push_back(level && middle ? 4.9e-3 - p[0] : flat.back());
  }
  EXPECT_NEAR(find_tears(mesh, bulging)[0].area, find_tears(mesh, flat)[0].area, 1e-12);
}

}  // namespace
}  // namespace tunica::meshing
