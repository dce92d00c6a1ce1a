#include "tunica/wall/surface.hpp"

#include <gtest/gtest.h>

#include "tunica/base/dual.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

using InMotions = Dual<double, 9>;

SupportState<double> some_triangle(std::mt19937& random) {
  SupportState<double> s;
  const Vec3<double> corner[3] = {{{0, 0, 0}}, {{1, 0, 0.3}}, {{0, 1, -0.2}}};
  for (int a = 0; a < 3; ++a) {
    s.X[a] = corner[a] + test::random_vector(random, 0.2);
    s.u[a] = test::random_vector(random, 0.2);
    s.velocity[a] = test::random_vector(random, 1.0);
  }
  return s;
}

/// The state as a function of the unknown: du/dx and d(du/dt)/dx are the two factors.
SupportState<InMotions> shifted(const SupportState<double>& s, double du_dx, double dvelocity_dx) {
  SupportState<InMotions> r;
  for (int a = 0; a < 3; ++a)
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
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(r.r[a][i], exact.r[a][i].value, 1e-14);
      for (int b = 0; b < 3; ++b)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(k.k[a][b][i][j], exact.r[a][i].d[3 * b + j], 1e-13);
    }
}

TEST(WallSurface, FollowerPressureTangent) {
  std::mt19937 random(1);
  const SupportState<double> s = some_triangle(random);
  const SupportState<InMotions> sd = shifted(s, 0.7, 0.0);
  Vec3<double> x[3];
  Vec3<InMotions> xd[3];
  for (int a = 0; a < 3; ++a) x[a] = s.X[a] + s.u[a], xd[a] = sd.X[a] + sd.u[a];
  SurfaceVector<double> r{};
  SurfaceMatrix<double> k{};
  SurfaceVector<InMotions> exact{};
  add_pressure(x, 2.5, r);
  add_pressure_tangent(x, 2.5, 0.7, k);
  add_pressure(xd, InMotions(2.5), exact);
  expect_equal(r, k, exact);
}

TEST(WallSurface, TissueSupportTangent) {
  std::mt19937 random(2);
  for (bool normal_only : {false, true}) {
    const SupportState<double> s = some_triangle(random);
    SurfaceVector<double> r{};
    SurfaceMatrix<double> k{};
    SurfaceVector<InMotions> exact{};
    add_support(s, TissueSupport<double>{3.0, 0.8, 1.5, normal_only}, r);
    add_support_tangent(s, TissueSupport<double>{3.0, 0.8, 1.5, normal_only}, 0.4, 1.3, k);
    add_support(shifted(s, 0.4, 1.3),
                TissueSupport<InMotions>{InMotions(3.0), InMotions(0.8), InMotions(1.5), normal_only}, exact);
    expect_equal(r, k, exact);
  }
}

/// A closed surface under uniform pressure is in balance, with forces p V-wise inward: sum of r.x = 3 p V.
TEST(WallSurface, PressureOnAClosedSurface) {
  const Vec3<double> x[4] = {{{0, 0, 0}}, {{2, 0, 0}}, {{0, 3, 0}}, {{0, 0, 1}}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  Vec3<double> total{{0, 0, 0}};
  double work = 0.0;
  for (const auto& f : faces) {
    const Vec3<double> t[3] = {x[f[0]], x[f[1]], x[f[2]]};
    SurfaceVector<double> r{};
    add_pressure(t, 2.0, r);
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) total[i] += r.r[a][i], work += r.r[a][i] * t[a][i];
  }
  EXPECT_NEAR(norm(total), 0.0, 1e-14);
  EXPECT_NEAR(work, 3.0 * 2.0 * 1.0, 1e-13);  // volume 1
}

TEST(WallSurface, DeadTractionCarriesItsResultant) {
  const Vec3<double> X[3] = {{{0, 0, 0}}, {{2, 0, 0}}, {{0, 3, 0}}};
  SurfaceVector<double> r{};
  add_dead_traction(X, Vec3<double>{{1.0, -2.0, 4.0}}, r);
  double sum[3] = {0, 0, 0};
  for (const auto& row : r.r)
    for (int i = 0; i < 3; ++i) sum[i] += row[i];
  EXPECT_NEAR(sum[0], -3.0, 1e-14);
  EXPECT_NEAR(sum[1], 6.0, 1e-14);
  EXPECT_NEAR(sum[2], -12.0, 1e-14);
}

TEST(WallSurface, NormalSupportLeavesTangentialMotionFree) {
  SupportState<double> s{};
  s.X[0] = {{0, 0, 0}}, s.X[1] = {{1, 0, 0}}, s.X[2] = {{0, 1, 0}};
  for (auto& u : s.u) u = {{0.3, -0.2, 0.1}};
  SurfaceVector<double> r{};
  add_support(s, TissueSupport<double>{6.0, 0.0, 0.0, true}, r);
  for (const auto& row : r.r) {
    EXPECT_NEAR(row[0], 0.0, 1e-15);
    EXPECT_NEAR(row[1], 0.0, 1e-15);
    EXPECT_NEAR(row[2], 6.0 * 0.1 * 0.5 / 3.0, 1e-15);
  }
}

}  // namespace
}  // namespace tunica::wall
