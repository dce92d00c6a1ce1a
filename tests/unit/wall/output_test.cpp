#include "tunica/wall/output.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/wall/material.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

using test::some_state;

/// The stress power of a uniform virtual velocity gradient: sum_a r_a . (L x_a) = v sigma : L.
TEST(WallOutput, CauchyStressIsWorkConjugate) {
  std::mt19937 random(13);
  for (bool mixed : {false, true}) {
    ElementState<double> e = some_state(random);
    for (auto& a : e.acceleration) a = {{0, 0, 0}};
    const Body body{.density = 1.0, .volumetric = {VolumetricEnergy::simo_taylor, 40.0}};
    const test::ExponentialFibre law;
    fe::ElementVector<double> r;
    if (mixed)
      mixed_residual(e, law, body, {}, r);
    else
      displacement_residual(e, law, body, r);
    const Symmetric<double> sigma = mixed ? mixed_cauchy_stress(e, law) : displacement_cauchy_stress(e, law, body);
    // Current positions relative to node 0 through F and the reference edges.
    Mat3<double> G;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) G(a, i) = e.reference.dN[a + 1][i];
    const Kinematics<double> k = kinematics(e);
    const Mat3<double> x = k.F * inverse(G);  // columns
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double power = 0.0;
        for (int a = 1; a < 4; ++a) power += r.r[a][i] * x(j, a - 1);
        EXPECT_NEAR(power, k.J * e.reference.volume * sigma[voigt_index[i][j]], 1e-13);
      }
  }
}

TEST(WallOutput, KineticEnergyOfAUniformAndOfALinearField) {
  const Vec3<double> uniform[4] = {{{1, 2, 2}}, {{1, 2, 2}}, {{1, 2, 2}}, {{1, 2, 2}}};
  EXPECT_NEAR(kinetic_energy(0.5, uniform, 4.0), 0.5 * 4.0 * 0.5 * 9.0, 1e-14);
  const Vec3<double> single[4] = {{{0, 0, 0}}, {{3, 0, 0}}, {{0, 0, 0}}, {{0, 0, 0}}};
  EXPECT_NEAR(kinetic_energy(0.5, single, 4.0), 0.5 * 4.0 * 0.5 * 9.0 / 10.0, 1e-14);
}

/// For the quadratic energy, p = -K (J - 1) makes both elements store the same.
TEST(WallOutput, StrainEnergiesAgreeForTheQuadraticEnergy) {
  std::mt19937 random(17);
  ElementState<double> e = some_state(random);
  const Body body{.density = 1.0, .volumetric = {VolumetricEnergy::quadratic, 40.0}};
  for (double& p : e.pressure) p = -40.0 * (kinematics(e).J - 1.0);
  EXPECT_NEAR(mixed_strain_energy(e, NeoHooke{2.0}, body), displacement_strain_energy(e, NeoHooke{2.0}, body), 1e-13);
  const Body incompressible{.density = 1.0, .volumetric = {}};
  EXPECT_NEAR(mixed_strain_energy(e, NeoHooke{2.0}, incompressible),
              e.reference.volume * NeoHooke{2.0}.energy(kinematics(e).C_bar), 1e-14);
}

/// With the quadratic energy the mixed equations derive from a potential: residual . dx = d(stored) when the pressure
/// satisfies its equation, that is dPi with Pi = Psi - p (J - 1) - p^2/(2 K) - tau/2 |grad p|^2.
TEST(WallOutput, MixedElementDerivesFromAPotential) {
  using D = Dual<double, 16>;
  std::mt19937 random(19);
  ElementState<double> e = some_state(random);
  for (auto& a : e.acceleration) a = {{0, 0, 0}};
  const Body body{.density = 1.0, .volumetric = {VolumetricEnergy::quadratic, 40.0}};
  ElementState<D> d = test::converted<D>(e);
  for (int a = 0; a < 4; ++a) {
    for (int i = 0; i < 3; ++i) d.displacement[a][i] = D::variable(e.displacement[a][i], 4 * a + i);
    d.pressure[a] = D::variable(e.pressure[a], 4 * a + 3);
  }
  const test::ExponentialFibre law;
  const Kinematics<D> k = kinematics(d);
  const D isochoric = d.reference.volume * law.energy(k.C_bar);
  const D work =
      d.reference.volume * (k.J - D(1.0)) * D(0.25) * (d.pressure[0] + d.pressure[1] + d.pressure[2] + d.pressure[3]);
  const D potential = D(2.0) * isochoric - mixed_strain_energy(d, law, body) - work;
  fe::ElementVector<double> r;
  mixed_residual(e, law, body, {.acceleration = 0.0, .displacement = 1.0, .constraint = -1.0}, r);
  for (int n = 0; n < 16; ++n) EXPECT_NEAR(r.r[n / 4][n % 4], potential.d[n], 1e-13);
}

// A simple shear of 2 turns and stretches the fibre along e2; one along e1 stays. The element has its gradients in axes
// that are turned by a quarter about e3.
TEST(WallOutput, StressAlongFibresFollowsTheirMotion) {
  const Vec3<double> X[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  ElementState<double> e{};
  set_reference(e, X, Vec3<double>{{0, 1, 0}}, Vec3<double>{{-1, 0, 0}});
  for (int a = 0; a < 4; ++a) e.displacement[a] = {{2 * X[a][1], 0, 0}};
  const Symmetric<double> sigma{{5, 7, 0, 1, 0, 0}};  // 11, 22, 33, 12
  // The second axis is -x, which the shear leaves alone; the first is y, which becomes (2, 1, 0).
  EXPECT_NEAR(fibre_stress(deformation_gradient(e), sigma, {{0, 1, 0}}), 5, 1e-14);
  EXPECT_NEAR(fibre_stress(deformation_gradient(e), sigma, {{1, 0, 0}}), (4 * 5 + 7 + 2 * 2 * 1) / 5.0, 1e-14);
}

TEST(WallOutput, MeanDirectionsOfTheFamiliesOfALaw) {
  constexpr double angle = 0.6;
  HgoParameters hgo;
  hgo.families.resize(2);
  hgo.families[0].mean_angle = angle;
  hgo.families[1].mean_angle = -angle;
  const auto directions = mean_fibre_directions(hgo);
  ASSERT_EQ(directions.size(), 2u);
  EXPECT_NEAR(directions[0][0], std::cos(angle), 1e-15);
  EXPECT_NEAR(directions[1][1], -std::sin(angle), 1e-15);
  DfdParameters dfd;
  dfd.families.resize(2);
  dfd.families[0].orientation = dfd::Bivariate{.in_plane = 1, .out_of_plane = 1, .mean_angle = angle};
  dfd.families[1].orientation =
      dfd::Symmetric{.concentration = 1, .mean_angle = {}, .mean_direction = Vec3<double>{{0, 0, 3}}};
  EXPECT_NEAR(mean_fibre_directions(dfd)[0][1], std::sin(angle), 1e-15);
  EXPECT_NEAR(mean_fibre_directions(dfd)[1][2], 1, 1e-15);
  EXPECT_TRUE(mean_fibre_directions(NeoHookeParameters{}).empty());
}

TEST(WallOutput, PrincipalStressesAndVonMises) {
  const Symmetric<double> uniaxial{{5.0, 0, 0, 0, 0, 0}};
  EXPECT_DOUBLE_EQ(von_mises(uniaxial), 5.0);
  // Eigenvalues 7, 2, -3 turned by a rotation.
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Mat3<double> Q{{{c, -s, 0}, {0.6 * s, 0.6 * c, -0.8}, {0.8 * s, 0.8 * c, 0.6}}};
  const double values[3] = {2.0, 7.0, -3.0};
  Symmetric<double> turned{};
  for (int n = 0; n < 6; ++n)
    for (int k = 0; k < 3; ++k) turned[n] += values[k] * Q(voigt_row[n], k) * Q(voigt_column[n], k);
  const Vec3<double> p = principal_stresses(turned);
  EXPECT_NEAR(p[0], 7.0, 1e-13);
  EXPECT_NEAR(p[1], 2.0, 1e-13);
  EXPECT_NEAR(p[2], -3.0, 1e-13);
  EXPECT_NEAR(von_mises(turned), std::sqrt(0.5 * (25.0 + 25.0 + 100.0)), 1e-12);
  const Vec3<double> spherical = principal_stresses({{4.0, 4.0, 4.0, 0, 0, 0}});
  EXPECT_DOUBLE_EQ(spherical[1], 4.0);
}

}  // namespace
}  // namespace tunica::wall
