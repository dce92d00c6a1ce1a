#include "tunica/geometry/centreline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace tunica::geometry {
namespace {

using std::numbers::pi;

Centreline crook() {
  Centreline line({{{0, 0, 0}}, {{0, 0, 1}}, {{1, 0, 0}}, {{0, 1, 0}}});
  line.append(0.06);
  line.append(0.11, 3.0, 2.0);
  line.append(0.2, -0.3, 0.7);
  return line;
}

TEST(Centreline, FramesAreOrthonormalAndSmooth) {
  const auto line = crook();
  EXPECT_DOUBLE_EQ(line.length(), 0.37);
  const double step = 1e-5;
  for (double s = step; s < line.length() - step; s += 0.0007) {
    const Frame f = line.frame(s), before = line.frame(s - step), after = line.frame(s + step);
    EXPECT_NEAR(norm(cross(f.tangent, f.e1) - f.e2), 0, 1e-12);
    EXPECT_NEAR(dot(f.tangent, f.e1), 0, 1e-12);
    EXPECT_NEAR(norm((0.5 / step) * (after.origin - before.origin) - f.tangent), 0, 1e-4);
    // Carried along without turning about the curve: the change of e1 is along the tangent.
    EXPECT_NEAR(dot(after.e1 - before.e1, f.e2), 0, 1e-9);
  }
}

TEST(Centreline, ClosestPointsAsBySampling) {
  const auto line = crook();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.08, 0.16);
  for (int k = 0; k < 200; ++k) {
    const Point p{{coordinate(random), coordinate(random), coordinate(random)}};
    const auto c = line.closest(p);
    double sampled = 1;
    for (double s = 0; s <= line.length(); s += 2e-4) sampled = std::min(sampled, norm(p - line.frame(s).origin));
    EXPECT_NEAR(c.distance, sampled, 2e-6);
    const Frame f = line.frame(c.s);
    EXPECT_NEAR(norm(p - f.origin), c.distance, 1e-12);
    EXPECT_NEAR(dot(p - f.origin, f.e1), c.x1, 1e-12);
    EXPECT_NEAR(dot(p - f.origin, f.e2), c.x2, 1e-12);
  }
}

TEST(Centreline, KnowsWhatLiesBeyondItsEnds) {
  const auto line = crook();
  EXPECT_NEAR(line.closest({{0.001, 0, -0.01}}).beyond, 0.01, 1e-12);
  EXPECT_LE(line.closest({{0.001, 0, 0.01}}).beyond, 0);
  const Frame last = line.frame(line.length());
  EXPECT_NEAR(line.closest(last.origin + 0.02 * last.tangent + 0.003 * last.e1).beyond, 0.02, 1e-12);
  EXPECT_LE(line.closest(line.frame(0.06).origin + 0.01 * last.e2).beyond, 0);
}

TEST(Centreline, BendsTowardsTheGivenDirection) {
  for (const double sign : {1.0, -1.0}) {
    Centreline line({{{0, 0, 0}}, {{0, 0, 1}}, {{1, 0, 0}}, {{0, 1, 0}}});
    line.append(pi / 2, sign * pi / 2, pi / 2);  // a quarter of the unit circle towards e2, or away from it
    EXPECT_NEAR(norm(line.frame(pi / 2).origin - Point{{0, sign, 1}}), 0, 1e-12);
  }
}

}  // namespace
}  // namespace tunica::geometry
