#include "tunica/wall/element.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tunica/wall/output.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

using test::converted;
using test::ExponentialFibre;
using test::some_state;

constexpr double infinite = std::numeric_limits<double>::infinity();
using InOne = Dual<double, 1>;  // one unknown at a time: sixteen at once compile for a minute
using Matrix = fe::ElementMatrix<double>;
using Vector = fe::ElementVector<double>;

/// The state shifted by dx in the unknowns: x = (velocity or displacement, pressure) of the four nodes.
template <class T>
ElementState<T> shifted(const ElementState<double>& e, const Coefficients& c, const T (&dx)[16]) {
  ElementState<T> r = converted<T>(e);
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i) {
      r.displacement[a][i] += T(c.displacement) * dx[4 * a + i];
      r.acceleration[a][i] += T(c.acceleration) * dx[4 * a + i];
    }
    r.pressure[a] += dx[4 * a + 3];
  }
  return r;
}

/// function(dx) with the derivative along unknown n.
template <class Function>
auto derivative(int n, const Function& function) {
  InOne dx[16];
  dx[n] = InOne::variable(0.0, 0);
  return function(dx);
}

struct Mixed {
  template <class T, class L>
  static void residual(const ElementState<T>& e, const L& law, const Body& b, const Coefficients& c,
                       fe::ElementVector<T>& r) {
    mixed_residual(e, law, b, c, r);
  }
  template <class T, class L>
  static void tangent(const ElementState<T>& e, const L& law, const Body& b, const Coefficients& c,
                      fe::ElementVector<T>& r, fe::ElementMatrix<T>& k) {
    mixed_tangent(e, law, b, c, r, k);
  }
  static constexpr bool mixed = true;
};
struct Displacement {
  template <class T, class L>
  static void residual(const ElementState<T>& e, const L& law, const Body& b, const Coefficients&,
                       fe::ElementVector<T>& r) {
    displacement_residual(e, law, b, r);
  }
  template <class T, class L>
  static void tangent(const ElementState<T>& e, const L& law, const Body& b, const Coefficients& c,
                      fe::ElementVector<T>& r, fe::ElementMatrix<T>& k) {
    displacement_tangent(e, law, b, c, r, k);
  }
  static constexpr bool mixed = false;
};

template <class Element, class L>
void check_tangent(const L& law, const Body& body, const Coefficients& c) {
  std::mt19937 random(7);
  for (int sample = 0; sample < 5; ++sample) {
    const ElementState<double> e = some_state(random);
    Vector r, r_only;
    Matrix k;
    Element::tangent(e, law, body, c, r, k);
    Element::residual(e, law, body, c, r_only);
    Matrix exact;
    double size = 0.0;
    for (int n = 0; n < 16; ++n) {
      const auto column = derivative(n, [&](const InOne(&dx)[16]) {
        fe::ElementVector<InOne> v;
        Element::residual(shifted(e, c, dx), law, body, c, v);
        return v;
      });
      for (int a = 0; a < 4; ++a)
        for (int i = 0; i < 4; ++i) {
          exact.k[a][n / 4][i][n % 4] = column.r[a][i].d[0];
          size = std::max(size, std::fabs(column.r[a][i].d[0]));
        }
    }
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(r.r[a][i], r_only.r[a][i], 1e-14 * size);
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 4; ++j)
            ASSERT_NEAR(k.k[a][b][i][j], exact.k[a][b][i][j], 1e-12 * size) << a << b << i << j;
      }
  }
}

Body body_with(VolumetricEnergy energy, double bulk) {
  return {.density = 1.3, .volumetric = {energy, bulk}, .stabilisation = 0.2};
}

TEST(WallElement, TangentIsTheDerivativeOfTheResidual) {
  const Coefficients c{.acceleration = 5.0, .displacement = 0.3, .constraint = 1.7};
  for (VolumetricEnergy v : {VolumetricEnergy::simo_taylor, VolumetricEnergy::quadratic, VolumetricEnergy::miehe}) {
    check_tangent<Displacement>(NeoHooke{2.0}, body_with(v, 30.0), c);
    check_tangent<Displacement>(ExponentialFibre{}, body_with(v, 30.0), c);
    check_tangent<Mixed>(NeoHooke{2.0}, body_with(v, 30.0), c);
    check_tangent<Mixed>(NeoHooke{2.0}, body_with(v, infinite), c);
    check_tangent<Mixed>(ExponentialFibre{}, body_with(v, infinite), c);
  }
}

/// Central differences along a random direction, halving the step: the error must fall fourfold.
TEST(WallElement, TangentAgainstDifferencesIsSecondOrder) {
  std::mt19937 random(3);
  const ElementState<double> e = some_state(random);
  const Body body = body_with(VolumetricEnergy::simo_taylor, infinite);
  const Coefficients c{.acceleration = 2.0, .displacement = 0.5, .constraint = 0.8};
  Vector r;
  Matrix k;
  mixed_tangent(e, ExponentialFibre{}, body, c, r, k);
  double direction[16];
  for (double& x : direction) x = test::random_vector(random, 1.0)[0];
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const double h = level == 0 ? 2e-3 : 1e-3;
    double plus[16], minus[16];
    for (int n = 0; n < 16; ++n) {
      plus[n] = h * direction[n];
      minus[n] = -h * direction[n];
    }
    Vector rp, rm;
    mixed_residual(shifted(e, c, plus), ExponentialFibre{}, body, c, rp);
    mixed_residual(shifted(e, c, minus), ExponentialFibre{}, body, c, rm);
    error[level] = 0.0;
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i) {
        double linear = 0.0;
        for (int n = 0; n < 16; ++n) linear += k.k[a][n / 4][i][n % 4] * direction[n];
        error[level] += std::pow((rp.r[a][i] - rm.r[a][i]) / (2 * h) - linear, 2);
      }
    error[level] = std::sqrt(error[level]);
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.02);
}

TEST(WallElement, SymmetryOfTheTangent) {
  std::mt19937 random(11);
  const ElementState<double> e = some_state(random);
  const Coefficients c{.acceleration = 5.0, .displacement = 0.3, .constraint = 1.7};
  Vector r;
  Matrix k;
  const auto expect_symmetric = [&](int first, int last) {
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        for (int i = first; i < last; ++i)
          for (int j = first; j < last; ++j) EXPECT_NEAR(k.k[a][b][i][j], k.k[b][a][j][i], 1e-12);
  };
  displacement_tangent(e, ExponentialFibre{}, body_with(VolumetricEnergy::miehe, 30.0), c, r, k);
  expect_symmetric(0, 4);
  mixed_tangent(e, ExponentialFibre{}, body_with(VolumetricEnergy::miehe, infinite), c, r, k);
  expect_symmetric(0, 3);
  expect_symmetric(3, 4);
}

TEST(WallElement, PressureBlockIsPositiveAlsoWhenIncompressible) {
  std::mt19937 random(5);
  for (double bulk : {30.0, infinite}) {
    const ElementState<double> e = some_state(random);
    Vector r;
    Matrix k;
    mixed_tangent(e, NeoHooke{2.0}, body_with(VolumetricEnergy::simo_taylor, bulk), {}, r, k);
    for (int sample = 0; sample < 20; ++sample) {
      double q[4], energy = 0.0, mean = 0.0;
      for (double& x : q) mean += 0.25 * (x = test::random_vector(random, 1.0)[0]);
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) energy += (q[a] - mean) * k.k[a][b][3][3] * (q[b] - mean);
      EXPECT_GT(energy, 0.0);
    }
  }
}

/// With J = 1 + small and the quadratic energy the coupling blocks are each other's negative transpose.
TEST(WallElement, CouplingBlocksAtRest) {
  std::mt19937 random(5);
  ElementState<double> e = some_state(random, 0.0);
  for (int a = 0; a < 4; ++a) e.acceleration[a] = {{0, 0, 0}}, e.pressure[a] = 0.7;
  Vector r;
  Matrix k;
  mixed_tangent(e, NeoHooke{2.0}, body_with(VolumetricEnergy::miehe, infinite), {}, r, k);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(k.k[a][b][i][3], -k.k[b][a][3][i], 1e-15);
}

TEST(WallElement, AtRestAndUnderRigidMotionNoForce) {
  std::mt19937 random(23);
  ElementState<double> e = some_state(random, 0.0);
  const double angle = 1.1, co = std::cos(angle), si = std::sin(angle);
  const Mat3<double> Q{{{co, -si, 0}, {0.6 * si, 0.6 * co, -0.8}, {0.8 * si, 0.8 * co, 0.6}}};
  // Positions that belong to the gradients: x_a - x_0 from the inverse of the gradient matrix.
  Mat3<double> G;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) G(a, i) = e.reference.dN[a + 1][i];
  const Mat3<double> edges = inverse(G);
  for (int a = 0; a < 4; ++a) {
    Vec3<double> x{{0, 0, 0}};
    if (a > 0) x = {{edges(0, a - 1), edges(1, a - 1), edges(2, a - 1)}};
    e.displacement[a] = Q * x - x;
    e.acceleration[a] = {{0, 0, 0}};
    e.pressure[a] = 0.0;
  }
  Vector r;
  displacement_residual(e, NeoHooke{2.0}, body_with(VolumetricEnergy::simo_taylor, 1e3), r);
  for (const auto& row : r.r)
    for (double x : row) EXPECT_NEAR(x, 0.0, 1e-12);
  mixed_residual(e, NeoHooke{2.0}, body_with(VolumetricEnergy::miehe, infinite), {}, r);
  for (const auto& row : r.r)
    for (double x : row) EXPECT_NEAR(x, 0.0, 1e-14);
}

/// The mass carries rho_0 V a for a uniform acceleration, and rho_0 V/10, V/20 to the nodes.
TEST(WallElement, InertiaIsTheConsistentMass) {
  std::mt19937 random(29);
  ElementState<double> e = some_state(random, 0.0);
  for (int a = 0; a < 4; ++a) e.acceleration[a] = {{0, 0, 0}}, e.pressure[a] = 0.0;
  e.acceleration[2] = {{3.0, 0, 0}};
  Vector r;
  displacement_residual(e, NeoHooke{2.0}, body_with(VolumetricEnergy::quadratic, 10.0), r);
  const double mass = 1.3 * e.reference.volume;
  for (int a = 0; a < 4; ++a) EXPECT_NEAR(r.r[a][0], 3.0 * mass * (a == 2 ? 0.1 : 0.05), 1e-15);
}

/// The virtual power of the internal force is the rate of the stored energy.
TEST(WallElement, DisplacementElementForceIsTheDerivativeOfTheEnergy) {
  std::mt19937 random(31);
  ElementState<double> e = some_state(random);
  for (auto& a : e.acceleration) a = {{0, 0, 0}};
  const Body body = body_with(VolumetricEnergy::miehe, 20.0);
  Vector r;
  displacement_residual(e, ExponentialFibre{}, body, r);
  for (int n = 0; n < 16; ++n) {
    const InOne energy = derivative(n, [&](const InOne(&dx)[16]) {
      const ElementState<InOne> s = shifted(e, {}, dx);
      const Kinematics<InOne> k = kinematics(s);
      return s.reference.volume * (ExponentialFibre{}.energy(k.C_bar) + InOne(20.0) * body.volumetric.unit_energy(k.J));
    });
    if (n % 4 < 3) {
      EXPECT_NEAR(r.r[n / 4][n % 4], energy.d[0], 1e-13);
    }
  }
}

template <class Element, class L>
void check_pack(const L& law) {
  std::mt19937 random(37);
  const Body body = body_with(VolumetricEnergy::simo_taylor, 30.0);
  const Coefficients c{.acceleration = 5.0, .displacement = 0.3, .constraint = 1.7};
  ElementState<double> lanes[4];
  ElementState<Pack<4>> batch;
  for (int l = 0; l < 4; ++l) {
    lanes[l] = some_state(random);
    batch.reference.volume.set(l, lanes[l].reference.volume);
    for (int a = 0; a < 4; ++a) {
      batch.pressure[a].set(l, lanes[l].pressure[a]);
      for (int i = 0; i < 3; ++i) {
        batch.reference.dN[a][i].set(l, lanes[l].reference.dN[a][i]);
        batch.displacement[a][i].set(l, lanes[l].displacement[a][i]);
        batch.acceleration[a][i].set(l, lanes[l].acceleration[a][i]);
      }
    }
  }
  fe::ElementVector<Pack<4>> rb;
  fe::ElementMatrix<Pack<4>> kb;
  Element::tangent(batch, law, body, c, rb, kb);
  for (int l = 0; l < 4; ++l) {
    Vector r;
    Matrix k;
    Element::tangent(lanes[l], law, body, c, r, k);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(rb.r[a][i][l], r.r[a][i], 1e-13);
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 4; ++j) EXPECT_NEAR(kb.k[a][b][i][j][l], k.k[a][b][i][j], 1e-13);
      }
  }
}

TEST(WallElement, BatchesEqualSingleElements) {
  check_pack<Displacement>(NeoHooke{2.0});
  check_pack<Mixed>(NeoHooke{2.0});
  check_pack<Mixed>(ExponentialFibre{});
}

TEST(WallElement, InvertedElementGivesNaN) {
  std::mt19937 random(41);
  ElementState<double> e = some_state(random, 0.0);
  for (int i = 0; i < 3; ++i)
    e.displacement[1][i] = -2.0 * e.reference.dN[1][i] / dot(e.reference.dN[1], e.reference.dN[1]);
  Vector r;
  displacement_residual(e, NeoHooke{2.0}, body_with(VolumetricEnergy::quadratic, 10.0), r);
  EXPECT_TRUE(std::isnan(r.r[0][0]));
  mixed_residual(e, NeoHooke{2.0}, body_with(VolumetricEnergy::quadratic, 10.0), {}, r);
  EXPECT_TRUE(std::isnan(r.r[0][0]));
}

/// Forces do not know in which frame the gradients are stored, if the direction of the law is stated in it.
TEST(WallElement, GradientsInAFrameGiveTheSameForces) {
  std::mt19937 random(11);
  const Body body{.density = 3.0, .volumetric = {VolumetricEnergy::simo_taylor, 500.0}};
  const Vec3<double> e1{{0.36, 0.48, -0.8}}, e2{{-0.8, 0.6, 0.0}}, e3 = cross(e1, e2);
  const Vec3<double> fibre{{0.6, 0.64, 0.48}}, in_frame{{dot(fibre, e1), dot(fibre, e2), dot(fibre, e3)}};
  const test::FibreAlong global_law{fibre, 30.0, 20.0}, local_law{in_frame, 30.0, 20.0};
  ElementState<double> global = some_state(random), local = global;
  const Vec3<double> X[4] = {{{0, 0, 0}}, {{1.1, 0.1, 0}}, {{0.2, 0.9, 0.1}}, {{-0.1, 0.1, 1.2}}};
  set_reference(global, X);
  set_reference(local, X, e1, e2);
  Vector r, r_local;
  Matrix k, k_local;
  const auto expect_equal = [&] {
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(r_local.r[a][i], r.r[a][i], 1e-11);
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 3; ++j) EXPECT_NEAR(k_local.k[a][b][i][j], k.k[a][b][i][j], 1e-10);
      }
  };
  displacement_tangent(global, global_law, body, {2.0, 0.5, 1.0}, r, k);
  displacement_tangent(local, local_law, body, {2.0, 0.5, 1.0}, r_local, k_local);
  expect_equal();
  mixed_tangent(global, global_law, body, {2.0, 0.5, 1.0}, r, k);
  mixed_tangent(local, local_law, body, {2.0, 0.5, 1.0}, r_local, k_local);
  expect_equal();
  const auto sigma = mixed_cauchy_stress(global, global_law), again = mixed_cauchy_stress(local, local_law);
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(again[n], sigma[n], 1e-11);
}

/// (1.16) on a fibre along e1 stretched to l with the energy k (I - 1)^2: CC_1111 = 8 k, so |F F CC F F| = 8 k l^4.
TEST(WallElement, PresentModulusOfAFibre) {
  const test::FibreAlong law{{{1.0, 0.0, 0.0}}, 15.0, 20.0};
  const double l = 1.3, w = 1.0 / std::sqrt(l);
  const Vec3<double> X[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  ElementState<double> e{};
  set_reference(e, X);
  EXPECT_NEAR(present_modulus(e, law), 20.0 + 120.0 / std::sqrt(45.0), 1e-12);
  e.displacement[1] = {{l - 1.0, 0, 0}}, e.displacement[2] = {{0, w - 1.0, 0}}, e.displacement[3] = {{0, 0, w - 1.0}};
  EXPECT_NEAR(present_modulus(e, law), 20.0 + 120.0 * l * l * l * l / std::sqrt(45.0), 1e-11);
  EXPECT_EQ(present_modulus(e, NeoHooke{7.0}), 7.0);
}

TEST(WallElement, StabilisationUsesTheEdgeOfARegularTetrahedron) {
  ElementState<double> e{};
  const Vec3<double> x[4] = {{{1, 1, 1}}, {{-1, 1, -1}}, {{1, -1, -1}}, {{-1, -1, 1}}};
  e.reference = fe::gradients(x);
  const Body body{.density = 1.0, .volumetric = {}, .stabilisation = 0.25};
  EXPECT_NEAR(subscale_compliance(e, NeoHooke{4.0}, body), 0.25 * 8.0 / 4.0, 1e-14);  // edge^2 = 8
}

}  // namespace
}  // namespace tunica::wall
