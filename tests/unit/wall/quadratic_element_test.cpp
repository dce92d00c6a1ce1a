#include "tunica/wall/quadratic_element.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tunica/wall/quadratic_output.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall::quadratic {
namespace {

using wall::test::random_vector;

constexpr double infinite = std::numeric_limits<double>::infinity();
using D = Dual<double, 1>;  // one unknown at a time

ElementState<double> some_state(std::mt19937& random, double displacement = 0.05) {
  ElementState<double> e;
  e.reference = wall::test::some_tetrahedron(random);
  for (int a = 0; a < nodes; ++a) {
    e.displacement[a] = random_vector(random, displacement);
    e.acceleration[a] = random_vector(random, 2.0);
  }
  for (double& p : e.pressure) p = random_vector(random, 4.0)[0];
  return e;
}

/// Another one at each point.
PointPrestress<double> some_prestress(PrestressKind kind, std::mt19937& random) {
  PointPrestress<double> prestress{};
  prestress.kind = kind;
  for (int q = 0; q < points; ++q) {
    for (int n = 0; n < voigt_size; ++n) prestress.stress[q][n] = random_vector(random, 0.7)[0];
    prestress.stretch[q] = identity<double>();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) prestress.stretch[q](i, j) += random_vector(random, 0.1)[0];
  }
  return prestress;
}

PointPrestress<D> as_dual(const PointPrestress<double>& prestress) {
  PointPrestress<D> r{};
  r.kind = prestress.kind;
  for (int q = 0; q < points; ++q) {
    for (int n = 0; n < voigt_size; ++n) r.stress[q][n] = D(prestress.stress[q][n]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.stretch[q](i, j) = D(prestress.stretch[q](i, j));
  }
  return r;
}

/// Corners that belong to the gradients (the first at the origin) and the middles of the edges.
std::array<Vec3<double>, nodes> positions(const fe::Gradients<double>& g) {
  Mat3<double> G;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 3; ++i) G(a, i) = g.dN[a + 1][i];
  const Mat3<double> edges = inverse(G);
  std::array<Vec3<double>, nodes> x{};
  for (int a = 1; a < 4; ++a) x[a] = {{edges(0, a - 1), edges(1, a - 1), edges(2, a - 1)}};
  for (int b = 4; b < nodes; ++b) x[b] = 0.5 * (x[fe::gradient_of[b][0]] + x[fe::gradient_of[b][1]]);
  return x;
}

/// The state shifted by dx in unknown n: three for each node, then the pressures.
ElementState<D> shifted(const ElementState<double>& e, const Coefficients& c, int n) {
  ElementState<D> r;
  r.reference.volume = D(e.reference.volume);
  for (int a = 0; a < fe::nodes; ++a) {
    r.pressure[a] = D(e.pressure[a]);
    for (int i = 0; i < 3; ++i) r.reference.dN[a][i] = D(e.reference.dN[a][i]);
  }
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) {
      r.displacement[a][i] = D(e.displacement[a][i]);
      r.acceleration[a][i] = D(e.acceleration[a][i]);
    }
  if (n < 30) {
    r.displacement[n / 3][n % 3].d[0] = c.displacement;
    r.acceleration[n / 3][n % 3].d[0] = c.acceleration;
  } else {
    r.pressure[n - 30].d[0] = 1.0;
  }
  return r;
}

struct Matrix {
  double r[34], k[34][34];
};

template <bool mixed, class L>
Matrix assembled(const ElementState<double>& e, const L& law, const Body& body, const Coefficients& c,
                 const PointPrestress<double>& prestress = {}) {
  Matrix m{};
  ElementVector<double> r;
  tangent<mixed>(e, law, body, c, prestress, r, [&](int a, const TangentRow<double>& row) {
    for (int b = 0; b < nodes; ++b)
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) m.k[3 * a + i][3 * b + j] = row.motion[b](i, j);
        if (mixed && a < 4) m.k[30 + a][3 * b + j] = row.constraint[b][j];
      }
    for (int b = 0; b < 4 && mixed; ++b) {
      for (int i = 0; i < 3; ++i) m.k[3 * a + i][30 + b] = row.pressure[b][i];
      if (a < 4) m.k[30 + a][30 + b] = row.compressibility[b];
    }
  });
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) m.r[3 * a + i] = r.momentum[a][i];
  for (int a = 0; a < 4; ++a) m.r[30 + a] = r.constraint[a];
  return m;
}

/// A law by its energies alone: what is written by hand need not know dual numbers.
template <class L>
struct ByEnergy {
  const L& law;
  template <class T>
  T energy(const Symmetric<T>& C) const {
    return law.energy(C);
  }
  double shear_modulus_at_rest() const { return law.shear_modulus_at_rest(); }
  bool has_unsplit_part() const { return wall::has_unsplit_part(law); }
  template <class T>
  Symmetric<T> unsplit_stress(const Symmetric<T>& at) const {
    if constexpr (can_be_unsplit<L>)
      return derived_stress([&](const auto& C) { return law.unsplit_energy(C); }, at);
    else
      return at;
  }
};

template <bool mixed, class L>
void check_tangent(const L& law, const Body& body, const PointPrestress<double>& prestress = {}) {
  const Coefficients c{.acceleration = 5.0, .displacement = 0.3, .constraint = 1.7};
  std::mt19937 random(7);
  for (int sample = 0; sample < 3; ++sample) {
    const auto e = some_state(random);
    const Matrix m = assembled<mixed>(e, law, body, c, prestress);
    double error = 0, size = 0, residual_error = 0;
    for (int n = 0; n < 34; ++n) {
      ElementVector<D> v;
      residual<mixed>(shifted(e, c, n), ByEnergy<L>{law}, body, c, as_dual(prestress), v);
      for (int p = 0; p < 34; ++p) {
        const D& exact = p < 30 ? v.momentum[p / 3][p % 3] : v.constraint[p - 30];
        size = std::max(size, std::fabs(exact.d[0]));
        error = std::max(error, std::fabs(m.k[p][n] - exact.d[0]));
        residual_error = std::max(residual_error, std::fabs(m.r[p] - exact.value));
      }
    }
    EXPECT_LT(error, 1e-12 * size);
    EXPECT_LT(residual_error, 1e-13 * size);
  }
}

Body body_with(VolumetricEnergy energy, double bulk) { return {.density = 1.3, .volumetric = {energy, bulk}}; }

TEST(QuadraticWallElement, TangentIsTheDerivativeOfTheResidual) {
  for (VolumetricEnergy v : {VolumetricEnergy::simo_taylor, VolumetricEnergy::quadratic, VolumetricEnergy::miehe}) {
    check_tangent<false>(NeoHooke{2.0}, body_with(v, 30.0));
    check_tangent<true>(NeoHooke{2.0}, body_with(v, 30.0));
    check_tangent<true>(NeoHooke{2.0}, body_with(v, infinite));
    check_tangent<true>(wall::test::ExponentialFibre{}, body_with(v, infinite));
  }
  check_tangent<false>(wall::test::ExponentialFibre{}, body_with(VolumetricEnergy::miehe, 30.0));
  std::mt19937 random(3);
  for (const auto kind : {PrestressKind::stress, PrestressKind::stretch}) {
    const auto prestress = some_prestress(kind, random);
    check_tangent<true>(NeoHooke{2.0}, body_with(VolumetricEnergy::miehe, infinite), prestress);
    check_tangent<true>(wall::test::ExponentialFibre{}, body_with(VolumetricEnergy::simo_taylor, 30.0), prestress);
    check_tangent<false>(NeoHooke{2.0}, body_with(VolumetricEnergy::miehe, 30.0), prestress);
  }
}

TEST(QuadraticWallElement, TangentIsTheDerivativeWithFibresInsideAndOutsideTheSplit) {
  for (const bool unsplit : {false, true}) {
    HgoParameters hgo;
    hgo.elastic.shear_modulus = 2.0;
    hgo.options.unsplit = unsplit;
    hgo.families = {{{3.0, 5.0}, 0.6}, {{2.0, 0.0}, -0.6}};
    check_tangent<true>(hgo.law(), body_with(VolumetricEnergy::simo_taylor, infinite));
    GohParameters goh;
    goh.elastic.shear_modulus = 2.0;
    goh.options.unsplit = unsplit;
    goh.families.resize(1);
    goh.families[0].energy = {3.0, 5.0};
    goh.families[0].kappa = 0.1;
    check_tangent<true>(goh.law(), body_with(VolumetricEnergy::miehe, 100.0));
    check_tangent<false>(goh.law(), body_with(VolumetricEnergy::miehe, 30.0));
    DfdParameters dfd;
    dfd.elastic.shear_modulus = 2.0;
    dfd.options.unsplit = unsplit;
    dfd.rule = dfd::Octahedral{64};
    dfd.families.resize(1);
    dfd.families[0].energy = {3.0, 4.0};
    dfd.families[0].orientation = dfd::Bivariate{2.0, 10.0, 0.5};
    check_tangent<true>(dfd.law(), body_with(VolumetricEnergy::quadratic, infinite));
    check_tangent<false>(dfd.law(), body_with(VolumetricEnergy::quadratic, 30.0));
  }
}

TEST(QuadraticWallElement, SymmetryOfTheTangent) {
  std::mt19937 random(11);
  const auto e = some_state(random);
  const Coefficients c{.acceleration = 5.0, .displacement = 0.3, .constraint = 1.7};
  const auto asymmetry = [](const Matrix& m, int last) {
    double most = 0;
    for (int p = 0; p < last; ++p)
      for (int q = 0; q < last; ++q) most = std::max(most, std::fabs(m.k[p][q] - m.k[q][p]));
    return most;
  };
  const wall::test::ExponentialFibre law;
  EXPECT_LT(asymmetry(assembled<false>(e, law, body_with(VolumetricEnergy::miehe, 30.0), c), 34), 1e-12);
  EXPECT_LT(asymmetry(assembled<true>(e, law, body_with(VolumetricEnergy::miehe, infinite), c), 30), 1e-12);
}

TEST(QuadraticWallElement, UnderRigidMotionNoForceAndForcesTurnWithTheElement) {
  std::mt19937 random(23);
  auto e = some_state(random);
  for (auto& a : e.acceleration) a = {{0, 0, 0}};
  const double angle = 1.1, co = std::cos(angle), si = std::sin(angle);
  const Mat3<double> Q{{{co, -si, 0}, {0.6 * si, 0.6 * co, -0.8}, {0.8 * si, 0.8 * co, 0.6}}};
  const auto x = positions(e.reference);
  auto still = e, turned = e;
  for (int a = 0; a < nodes; ++a) {
    still.displacement[a] = Q * x[a] - x[a] + Vec3<double>{{3, -1, 2}};
    turned.displacement[a] = Q * (x[a] + e.displacement[a]) - x[a] + Vec3<double>{{3, -1, 2}};
  }
  for (double& p : still.pressure) p = 0;
  ElementVector<double> r;
  residual<false>(still, NeoHooke{2.0}, body_with(VolumetricEnergy::simo_taylor, 1e2), {}, {}, r);
  for (const auto& f : r.momentum) EXPECT_LT(norm(f), 1e-12);
  residual<true>(still, NeoHooke{2.0}, body_with(VolumetricEnergy::miehe, infinite), {}, {}, r);
  for (const auto& f : r.momentum) EXPECT_LT(norm(f), 1e-13);
  for (const double c : r.constraint) EXPECT_NEAR(c, 0, 1e-14);

  const wall::test::ExponentialFibre law;
  const auto body = body_with(VolumetricEnergy::miehe, 30.0);
  ElementVector<double> rotated;
  residual<true>(e, law, body, {}, {}, r);
  residual<true>(turned, law, body, {}, {}, rotated);
  for (int a = 0; a < nodes; ++a) EXPECT_LT(norm(Q * r.momentum[a] - rotated.momentum[a]), 1e-12);
  for (int a = 0; a < 4; ++a) EXPECT_NEAR(r.constraint[a], rotated.constraint[a], 1e-13);
}

TEST(QuadraticWallElement, ATranslationIsExactlyNoForce) {
  std::mt19937 random(2);
  auto e = some_state(random);
  for (auto& u : e.displacement) u = {{0.1, 1.7, -0.3}};
  for (auto& a : e.acceleration) a = {{0, 0, 0}};
  auto still = e;
  for (auto& u : still.displacement) u = {{0, 0, 0}};
  const auto body = body_with(VolumetricEnergy::quadratic, 30.0);
  ElementVector<double> r, at_rest;
  residual<true>(e, NeoHooke{2.0}, body, {}, {}, r);
  residual<true>(still, NeoHooke{2.0}, body, {}, {}, at_rest);
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(r.momentum[a][i], at_rest.momentum[a][i]);
}

/// Under a constant stress the force P V g_a of a linear corner is that of the mean gradient g_a. Shape functions of
/// corners have no mean gradient, those of edges the sum of their ends'.
TEST(QuadraticWallElement, HomogeneousDeformationGivesTheForcesOfTheLinearElement) {
  std::mt19937 random(5);
  const Mat3<double> F{{{1.1, 0.15, -0.05}, {0.02, 0.93, 0.08}, {-0.06, 0.04, 1.04}}};
  auto e = some_state(random);
  const auto x = positions(e.reference);
  wall::ElementState<double> linear{};
  linear.reference = e.reference;
  for (int a = 0; a < nodes; ++a) {
    e.displacement[a] = F * x[a] - x[a];
    e.acceleration[a] = {{0, 0, 0}};
    if (a < 4) linear.displacement[a] = e.displacement[a];
  }
  const wall::test::ExponentialFibre law;
  const auto body = body_with(VolumetricEnergy::simo_taylor, 20.0);
  // The pressure that the constraint asks for: the quadratic element resists others, the linear one does not.
  for (int a = 0; a < 4; ++a)
    e.pressure[a] = linear.pressure[a] = -20.0 * body.volumetric.unit_pressure(determinant(F));
  ElementVector<double> r;
  fe::ElementVector<double> expected;
  const auto compare = [&] {
    for (int b = 0; b < nodes; ++b)
      for (int i = 0; i < 3; ++i) {
        const double edge = expected.r[fe::gradient_of[b][0]][i] + expected.r[fe::gradient_of[b][1]][i];
        EXPECT_NEAR(r.momentum[b][i], b < 4 ? 0.0 : edge, 1e-13);
      }
  };
  residual<false>(e, law, body, {}, {}, r);
  displacement_residual(linear, law, body, expected);
  compare();
  residual<true>(e, law, body, {}, {}, r);
  mixed_residual(linear, law, body, {}, expected);
  compare();
  for (int a = 0; a < 4; ++a) EXPECT_NEAR(r.constraint[a], expected.r[a][3], 1e-14);
  const auto centre = at_centroid(e, {});
  const auto sigma = mixed_cauchy_stress(centre, law), of_linear = mixed_cauchy_stress(linear, law);
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(sigma[n], of_linear[n], 1e-12);
  for (int a = 0; a < 4; ++a) EXPECT_LT(norm(centre.displacement[a] - linear.displacement[a]), 1e-14);
}

TEST(QuadraticWallElement, InertiaIsTheConsistentMass) {
  std::mt19937 random(29);
  auto e = some_state(random, 0.0);
  for (double& p : e.pressure) p = 0;
  for (auto& a : e.acceleration) a = {{3.0, 0, 0}};
  ElementVector<double> r;
  residual<true>(e, NeoHooke{2.0}, body_with(VolumetricEnergy::quadratic, infinite), {}, {}, r);
  double sum = 0;
  for (const auto& f : r.momentum) sum += f[0];
  EXPECT_NEAR(sum, 3.0 * 1.3 * e.reference.volume, 1e-14);
  Vec3<double> v[nodes];
  for (auto& x : v) x = {{0, 2.0, 0}};
  EXPECT_NEAR(kinetic_energy(e.reference.volume, v, 1.3), 2.0 * 1.3 * e.reference.volume, 1e-14);
}

TEST(QuadraticWallElement, ForceIsTheDerivativeOfTheEnergy) {
  std::mt19937 random(31);
  auto e = some_state(random);
  for (auto& a : e.acceleration) a = {{0, 0, 0}};
  const auto body = body_with(VolumetricEnergy::miehe, 20.0);
  const wall::test::ExponentialFibre law;
  for (const auto kind : {PrestressKind::none, PrestressKind::stress, PrestressKind::stretch}) {
    const auto prestress = some_prestress(kind, random);
    ElementVector<double> r;
    residual<false>(e, law, body, {}, prestress, r);
    for (int n = 0; n < 30; ++n) {
      const D energy = strain_energy<false>(shifted(e, {.displacement = 1.0}, n), law, body, as_dual(prestress));
      EXPECT_NEAR(r.momentum[n / 3][n % 3], energy.d[0], 1e-12);
    }
  }
}

/// Forces do not know in which frame the gradients are stored, nor to which of two equal states they refer.
TEST(QuadraticWallElement, FramesAndPrestretch) {
  std::mt19937 random(11);
  const auto body = body_with(VolumetricEnergy::simo_taylor, 50.0);
  const Vec3<double> e1{{0.36, 0.48, -0.8}}, e2{{-0.8, 0.6, 0.0}}, e3 = cross(e1, e2);
  const Vec3<double> fibre{{0.6, 0.64, 0.48}}, in_frame{{dot(fibre, e1), dot(fibre, e2), dot(fibre, e3)}};
  const wall::test::FibreAlong global_law{fibre, 30.0, 20.0}, local_law{in_frame, 30.0, 20.0};
  const Vec3<double> X[4] = {{{0, 0, 0}}, {{1.1, 0.1, 0}}, {{0.2, 0.9, 0.1}}, {{-0.1, 0.1, 1.2}}};
  wall::ElementState<double> global_shape, local_shape;
  set_reference(global_shape, X);
  set_reference(local_shape, X, e1, e2);
  auto global = some_state(random), local = global;
  global.reference = global_shape.reference, global.axes = global_shape.axes;
  local.reference = local_shape.reference, local.axes = local_shape.axes;
  const Coefficients c{2.0, 0.5, 1.0};
  const auto expect_equal = [](const Matrix& a, const Matrix& b) {
    for (int p = 0; p < 34; ++p) {
      EXPECT_NEAR(a.r[p], b.r[p], 1e-11);
      for (int q = 0; q < 34; ++q) EXPECT_NEAR(a.k[p][q], b.k[p][q], 1e-11);
    }
  };
  expect_equal(assembled<true>(global, global_law, body, c), assembled<true>(local, local_law, body, c));

  // What the law sees of the motion u from a stretched state F0 is the motion (F0 - 1) X0 + u from the free one.
  const Mat3<double> F0{{{1.1, 0.15, -0.05}, {0.02, 0.93, 0.08}, {-0.06, 0.04, 1.04}}};
  set_prestretch(global_shape, F0);
  auto stretched = global, free = global;
  free.reference = global_shape.reference;
  const auto x = positions(global.reference), x0 = positions(free.reference);
  for (int a = 0; a < nodes; ++a) free.displacement[a] = global.displacement[a] + x[a] - x0[a];
  PointPrestress<double> prestretch{};
  prestretch.kind = PrestressKind::stretch;
  for (Mat3<double>& of_point : prestretch.stretch) of_point = F0;
  expect_equal(assembled<true>(stretched, global_law, body, c, prestretch), assembled<true>(free, global_law, body, c));
  EXPECT_NEAR(present_volume(stretched), present_volume(global), 1e-14);
  EXPECT_NEAR(stress_free_volume(stretched, prestretch), free.reference.volume, 1e-14);
}

/// F of each point as its prestretch: at rest it then has the stress that the element has when it moves.
TEST(QuadraticWallElement, PrestretchOfThePointsStandsForTheMotionThatMadeIt) {
  std::mt19937 random(13);
  const wall::test::ExponentialFibre law;
  const auto moved = some_state(random);
  PointPrestress<double> prestretch{};
  prestretch.kind = PrestressKind::stretch;
  double volume = 0;
  for (int q = 0; q < points; ++q) {
    const auto s = at_point(moved, fe::quadratic_four_points[static_cast<std::size_t>(q)]);
    prestretch.stretch[q] = deformation_gradient(s);
    volume += s.reference.volume / determinant(prestretch.stretch[q]);
    auto still = moved;
    for (auto& u : still.displacement) u = {};
    const auto found = at_point(still, q, prestretch);
    const auto sigma = mixed_cauchy_stress(found, law), expected = mixed_cauchy_stress(s, law);
    for (int n = 0; n < voigt_size; ++n) EXPECT_NEAR(sigma[n], expected[n], 1e-13);
  }
  EXPECT_NEAR(stress_free_volume(moved, prestretch), volume, 1e-15);
  const auto centre = at_centroid(moved, prestretch);
  double mean = 0;
  for (const auto& F0 : prestretch.stretch) mean += 0.25 * F0(0, 1);
  EXPECT_NEAR(centre.axes(0, 1), mean, 1e-15);
}

TEST(QuadraticWallElement, InvertedElementGivesNaN) {
  std::mt19937 random(41);
  auto e = some_state(random, 0.0);
  const auto x = positions(e.reference);
  for (int a = 0; a < nodes; ++a) e.displacement[a] = {{-2.0 * x[a][0], 0, 0}};
  ElementVector<double> r;
  residual<true>(e, NeoHooke{2.0}, body_with(VolumetricEnergy::quadratic, 10.0), {}, {}, r);
  EXPECT_TRUE(std::isnan(r.momentum[4][0]));
}

}  // namespace
}  // namespace tunica::wall::quadratic
