#include "tunica/wall/prestress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/wall/output.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

using test::ExponentialFibre;
using InOne = Dual<double, 1>;

const Symmetric<double> S0{{3.0, -1.0, 2.0, 0.7, -0.4, 1.1}};
const Mat3<double> F0{{{1.1, 0.05, -0.02}, {0.1, 0.95, 0.03}, {-0.04, 0.02, 1.07}}};

template <class T>
ElementState<T> shifted(const ElementState<double>& e, int n, double factor) {
  ElementState<T> s = test::converted<T>(e);
  s.displacement[n / 3][n % 3] += T(factor) * T::variable(0.0, 0);
  return s;
}

ElementState<double> state() {
  std::mt19937 random(7);
  return test::some_state(random);
}

TEST(Prestress, ForceIsTheDerivativeOfItsEnergyAndTangentThatOfTheForce) {
  const auto e = state();
  const Coefficients c{.displacement = 0.3};
  fe::ElementVector<double> r{};
  fe::ElementMatrix<double> k{};
  add_prestress_residual(e, S0, r);
  add_prestress_tangent(e, S0, c, k);
  Symmetric<InOne> S0_dual;
  for (int i = 0; i < voigt_size; ++i) S0_dual[i] = InOne(S0[i]);
  for (int n = 0; n < 12; ++n) {
    EXPECT_NEAR(r.r[n / 3][n % 3], prestress_energy(shifted<InOne>(e, n, 1.0), S0_dual).d[0], 1e-13);
    fe::ElementVector<InOne> varied{};
    add_prestress_residual(shifted<InOne>(e, n, c.displacement), S0_dual, varied);
    for (int m = 0; m < 12; ++m)
      EXPECT_NEAR(k.k[m / 3][n / 3][m % 3][n % 3], varied.r[m / 3][m % 3].d[0], 1e-13) << m << ", " << n;
  }
}

TEST(Prestress, AtRestIsTheStressItself) {
  auto e = state();
  for (auto& u : e.displacement) u = {};
  const auto sigma = prestress_cauchy_stress(e, S0);
  for (int i = 0; i < voigt_size; ++i) EXPECT_DOUBLE_EQ(sigma[i], S0[i]);
  EXPECT_EQ(prestress_energy(e, S0), 0.0);
}

TEST(Prestress, IsTheSameStressInAnyFrame) {
  const Vec3<double> e1{{0.6, 0.8, 0.0}}, e2{{0.0, 0.0, 1.0}},
      X[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0.1, 0, 1}}};
  ElementState<double> global = state(), turned = global;
  set_reference(global, X);
  set_reference(turned, X, e1, e2);
  fe::ElementVector<double> r{}, r_turned{};
  add_prestress_residual(global, S0, r);
  add_prestress_residual(turned, in_axes(turned.axes, S0), r_turned);
  for (int n = 0; n < 12; ++n) EXPECT_NEAR(r.r[n / 3][n % 3], r_turned.r[n / 3][n % 3], 1e-14);
}

// Moved by u from the imaged shape, the prestretched element is the stress-free one moved by u and the stretch.
TEST(Prestretch, IsAMotionFromTheStressFreeElement) {
  const Vec3<double> free[4] = {{{0, 0, 0}}, {{1, 0.1, 0}}, {{0, 1, 0.2}}, {{0.1, 0, 1}}};
  Vec3<double> imaged[4];
  for (int a = 0; a < 4; ++a) imaged[a] = F0 * free[a];
  ElementState<double> whole = state(), prestretched = whole;
  set_reference(whole, free);
  set_reference(prestretched, imaged);
  set_prestretch(prestretched, F0);
  for (int a = 0; a < 4; ++a) whole.displacement[a] = whole.displacement[a] + imaged[a] - free[a];
  const ExponentialFibre law;
  const Body body{.density = 2.0, .volumetric = {VolumetricEnergy::simo_taylor, 50.0}};
  const Coefficients c{1.5, 0.3, 0.7};
  fe::ElementVector<double> r, r_whole;
  fe::ElementMatrix<double> k, k_whole;
  mixed_tangent(prestretched, law, body, c, r, k);
  mixed_tangent(whole, law, body, c, r_whole, k_whole);
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(r.r[a][i], r_whole.r[a][i], 1e-12);
      for (int b = 0; b < 4; ++b)
        for (int j = 0; j < 4; ++j) EXPECT_NEAR(k.k[a][b][i][j], k_whole.k[a][b][i][j], 1e-11);
    }
  const auto sigma = mixed_cauchy_stress(prestretched, law), expected = mixed_cauchy_stress(whole, law);
  for (int i = 0; i < voigt_size; ++i) EXPECT_NEAR(sigma[i], expected[i], 1e-12);
}

}  // namespace
}  // namespace tunica::wall
