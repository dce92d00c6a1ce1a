#include "tunica/wall/quadratic_surface.hpp"

#include <gtest/gtest.h>

#include "tunica/base/dual.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall::quadratic {
namespace {

using InMotions = Dual<double, 18>;

SurfaceState<double> some_triangle(std::mt19937& random, double displacement = 0.2) {
  SurfaceState<double> s;
  const Vec3<double> corner[3] = {{{0, 0, 0}}, {{1, 0, 0.3}}, {{0, 1, -0.2}}};
  for (int a = 0; a < 3; ++a) s.X[a] = corner[a] + wall::test::random_vector(random, 0.2);
  for (int a = 0; a < 3; ++a) s.X[3 + a] = 0.5 * (s.X[a] + s.X[(a + 1) % 3]);
  for (int a = 0; a < 6; ++a) {
    s.u[a] = wall::test::random_vector(random, displacement);
    s.velocity[a] = wall::test::random_vector(random, 1.0);
  }
  return s;
}

SurfaceState<InMotions> shifted(const SurfaceState<double>& s, double du_dx, double dvelocity_dx) {
  SurfaceState<InMotions> r;
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 3; ++i) {
      const InMotions dx = InMotions::variable(0.0, 3 * a + i);
      r.X[a][i] = InMotions(s.X[a][i]);
      r.u[a][i] = InMotions(s.u[a][i]) + InMotions(du_dx) * dx;
      r.velocity[a][i] = InMotions(s.velocity[a][i]) + InMotions(dvelocity_dx) * dx;
    }
  return r;
}

void expect_equal(const SurfaceVector<double>& r, const SurfaceMatrix<double>& k,
                  const SurfaceVector<InMotions>& exact) {
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(r.r[a][i], exact.r[a][i].value, 1e-14);
      for (int b = 0; b < 6; ++b)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(k.k[a][b](i, j), exact.r[a][i].d[3 * b + j], 1e-13);
    }
}

TEST(QuadraticWallSurface, FollowerPressureTangent) {
  std::mt19937 random(1);
  const auto s = some_triangle(random);
  SurfaceVector<double> r{};
  SurfaceMatrix<double> k{};
  SurfaceVector<InMotions> exact{};
  add_follower_pressure(s, 2.5, 0.7, r, &k);
  add_follower_pressure(shifted(s, 0.7, 0.0), InMotions(2.5), 0.0, exact, nullptr);
  expect_equal(r, k, exact);
}

TEST(QuadraticWallSurface, TissueSupportTangent) {
  std::mt19937 random(2);
  for (bool normal_only : {false, true}) {
    const auto s = some_triangle(random);
    SurfaceVector<double> r{};
    SurfaceMatrix<double> k{};
    SurfaceVector<InMotions> exact{};
    add_support(s, TissueSupport<double>{3.0, 0.8, 1.5, normal_only}, 0.4, 1.3, r, &k);
    add_support(shifted(s, 0.4, 1.3),
                TissueSupport<InMotions>{InMotions(3.0), InMotions(0.8), InMotions(1.5), normal_only}, 0.0, 0.0, exact,
                nullptr);
    expect_equal(r, k, exact);
  }
}

TEST(QuadraticWallSurface, WithoutDeformationPressureActsOnTheEdges) {
  std::mt19937 random(3);
  const auto s = some_triangle(random, 0.0);
  SurfaceVector<double> follower{}, dead{}, traction{};
  add_follower_pressure(s, 2.0, 1.0, follower, nullptr);
  add_dead_pressure(s, 2.0, dead);
  const Vec3<double> A = detail::reference_area(s);
  add_dead_traction(s, (-2.0 / norm(A)) * A, traction);
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(dead.r[a][i], a < 3 ? 0.0 : 2.0 / 3.0 * A[i], 1e-15);
      EXPECT_NEAR(follower.r[a][i], dead.r[a][i], 1e-15);
      EXPECT_NEAR(traction.r[a][i], dead.r[a][i], 1e-15);
    }
}

/// The curved faces of a closed surface are in balance under pressure whatever their shape: the resultant of one with
/// fixed edges is that of the straight triangle, since int x,1 x x,2 depends on the rim alone. Here the nodes on the
/// edges bulge, and the rim of two triangles back to back is common.
TEST(QuadraticWallSurface, TheResultantDependsOnTheRimAlone) {
  std::mt19937 random(4);
  const auto s = some_triangle(random);
  SurfaceState<double> back = s;
  for (auto [to, from] : {std::pair(1, 2), {2, 1}, {3, 5}, {5, 3}}) back.X[to] = s.X[from], back.u[to] = s.u[from];
  SurfaceVector<double> r{};
  add_follower_pressure(s, 2.0, 1.0, r, nullptr);
  add_follower_pressure(back, 2.0, 1.0, r, nullptr);
  Vec3<double> total{{0, 0, 0}};
  for (const auto& f : r.r) total = total + f;
  EXPECT_LT(norm(total), 1e-14);
}

TEST(QuadraticWallSurface, TheMassIsThatOfTheShapeFunctions) {
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      double sum = 0;
      for (const auto& p : fe::quadratic_seven_points) sum += p.weight * p.N[a] * p.N[b];
      EXPECT_NEAR(fe::quadratic_triangle_mass[a][b], sum, 1e-15);
    }
  for (int a = 0; a < 10; ++a)
    for (int b = 0; b < 10; ++b) {
      double sum = 0;
      for (const auto& p : fe::quadratic_fourteen_points) sum += p.weight * p.N[a] * p.N[b];
      EXPECT_NEAR(fe::quadratic_mass[a][b], sum, 1e-15);
    }
}

}  // namespace
}  // namespace tunica::wall::quadratic
