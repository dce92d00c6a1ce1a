#include "tunica/geometry/thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::geometry {
namespace {

/// Faces of a box between 0 and `size`, each of n x n squares.
TriangleSurface box(const Vec3<double>& size, int n) {
  TriangleSurface surface;
  const auto face = [&](const Point& corner, const Vec3<double>& a, const Vec3<double>& b) {
    const auto first = std::ssize(surface.points);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) surface.points.push_back(corner + (1.0 * i / n) * a + (1.0 * j / n) * b);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto p = first + i * (n + 1) + j, q = p + n + 1;
        surface.triangles.push_back({p, q, q + 1});
        surface.triangles.push_back({p, q + 1, p + 1});
      }
  };
  const Vec3<double> x{{size[0], 0, 0}}, y{{0, size[1], 0}}, z{{0, 0, size[2]}}, o{{0, 0, 0}};
  face(o, y, x), face(z, x, y), face(o, x, z), face(y, z, x), face(o, z, y), face(x, y, z);
  return surface;
}

TEST(Thickness, OfAPlateIsTheDistanceOfItsFaces) {
  const TriangleTree tree(box({{20, 20, 2}}, 10));
  EXPECT_NEAR(thickness_at(tree, {{9, 11, 0}}, {{0, 0, -1}}, 50), 2, 0.01);
  EXPECT_NEAR(thickness_at(tree, {{9, 11, 2}}, {{0, 0, 1}}, 50), 2, 0.01);
}

// A tear's rim: the ball is held by the faces of the flap, not by its other end far away.
TEST(Thickness, OfARimIsThatOfThePlateBehindIt) {
  const TriangleTree tree(box({{20, 20, 2}}, 10));
  EXPECT_NEAR(thickness_at(tree, {{0, 10, 1}}, {{-1, 0, 0}}, 50), 2, 0.02);
}

TEST(Thickness, IsNoMoreThanAsked) {
  const TriangleTree tree(box({{20, 20, 20}}, 10));
  EXPECT_NEAR(thickness_at(tree, {{10, 10, 0}}, {{0, 0, -1}}, 5), 5, 1e-12);
}

// A shell of facets: their kinks, seen from its points, do not count.
TEST(Thickness, OfAFacetedShell) {
  constexpr int around = 40, rings = 21;
  TriangleSurface shell;
  for (const auto& [radius, outward] : {std::pair{12.0, true}, {10.0, false}}) {
    const auto first = std::ssize(shell.points);
    for (int k = 0; k < rings; ++k)
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * M_PI * i / around;
        shell.points.push_back({{radius * std::cos(angle), radius * std::sin(angle), 2.0 * k}});
      }
    for (int k = 0; k + 1 < rings; ++k)
      for (int i = 0; i < around; ++i) {
        const auto a = first + k * around + i, b = first + k * around + (i + 1) % around;
        const auto add = [&](std::int64_t p, std::int64_t q, std::int64_t r) {
          shell.triangles.push_back(outward ? Triangle{p, q, r} : Triangle{p, r, q});
        };
        add(a, b, b + around);
        add(a, b + around, a + around);
      }
  }
  const TriangleTree tree(shell);
  EXPECT_NEAR(thickness_at(tree, {{12, 0, 20}}, {{1, 0, 0}}, 50), 2, 0.05);
  EXPECT_NEAR(thickness_at(tree, {{10, 0, 20}}, {{-1, 0, 0}}, 50), 2, 0.1);
}

}  // namespace
}  // namespace tunica::geometry
