#include "tunica/wall/viscous_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::wall {
namespace {

class ViscousForces : public testing::TestWithParam<Viscosity::Law> {
 protected:
  using Point = ViscousPoint<double, 4>;
  static constexpr double eta = 3.0;

  static Point point() {
    Point p;
    p.volume = 0.7;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) {
        p.dN[a][i] = std::sin(1.0 + 3 * a + 2 * i * i + a * i);
        p.displacement[a][i] = 0.2 * std::cos(2.0 + 2 * a + 3 * i);
        p.velocity[a][i] = std::sin(5.0 + a * i + a);
      }
    for (int i = 0; i < 3; ++i) p.dN[0][i] = -(p.dN[1][i] + p.dN[2][i] + p.dN[3][i]);
    return p;
  }
  struct Forces {
    Vec3<double> r[4] = {};
  };
  Forces forces(const Point& p) const {
    Forces f;
    add_viscous_forces(p, {GetParam(), eta}, {1.0, 1.0}, f.r, static_cast<Mat3<double>(*)[4]>(nullptr));
    return f;
  }
};
INSTANTIATE_TEST_SUITE_P(Laws, ViscousForces, testing::Values(Viscosity::Law::newtonian, Viscosity::Law::potential));

TEST_P(ViscousForces, HaveTheTangentOfTheirDifferences) {
  constexpr double du = 0.3, dv = 1.7, h = 1e-6;
  const Point p = point();
  Forces f;
  Mat3<double> k[4][4] = {};
  add_viscous_forces(p, {GetParam(), eta}, {du, dv}, f.r, k);
  for (int b = 0; b < 4; ++b)
    for (int j = 0; j < 3; ++j) {
      Point plus = p, minus = p;
      plus.displacement[b][j] += h * du, minus.displacement[b][j] -= h * du;
      plus.velocity[b][j] += h * dv, minus.velocity[b][j] -= h * dv;
      const Forces above = forces(plus), below = forces(minus);
      for (int a = 0; a < 4; ++a)
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(k[a][b](i, j), (above.r[a][i] - below.r[a][i]) / (2 * h), 1e-7) << a << i << b << j;
    }
}

TEST_P(ViscousForces, DissipateAndTakeNoPartInRigidMotion) {
  Point p = point();
  const Forces f = forces(p);
  double power = 0;
  Vec3<double> sum{};
  for (int a = 0; a < 4; ++a) power += dot(f.r[a], p.velocity[a]), sum = sum + f.r[a];
  EXPECT_GT(power, 0.0);
  EXPECT_LT(norm(sum), 1e-13);
  // v = omega x x about the deformed places; the gradients belong to corners at X with sum X (x) dN = 1.
  const Mat3<double> F = identity<double>() + p.gradient(p.displacement);
  const Mat3<double> spin{{{0.0, -2.0, 1.0}, {2.0, 0.0, -3.0}, {-1.0, 3.0, 0.0}}};
  // Velocities whose gradient is spin F: any with sum v (x) dN = spin F serve; least squares over three corners.
  Mat3<double> D;
  for (int a = 1; a < 4; ++a)
    for (int i = 0; i < 3; ++i) D(a - 1, i) = p.dN[a][i];
  const Mat3<double> v = spin * F * inverse(D);
  p.velocity[0] = {};
  for (int a = 1; a < 4; ++a)
    for (int i = 0; i < 3; ++i) p.velocity[a][i] = v(i, a - 1);
  for (const auto& r : forces(p).r) EXPECT_LT(norm(r), 1e-12);
}

}  // namespace
}  // namespace tunica::wall
