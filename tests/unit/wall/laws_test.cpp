// The tests that every law of the list passes: a new law needs only example_laws().
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tunica/wall/output.hpp"
#include "unit/wall/test_laws.hpp"

namespace tunica::wall {
namespace {

/// Parameters to test a law with.
template <class L>
L example();
template <>
NeoHooke example<NeoHooke>() {
  return {.shear_modulus = 50e3};
}
template <>
MooneyRivlin example<MooneyRivlin>() {
  return {.c1 = 20e3, .c2 = 5e3};
}
template <>
StVenantKirchhoff example<StVenantKirchhoff>() {
  return {.shear_modulus = 50e3};
}
template <>
StructureTensorLaw example<StructureTensorLaw>() {
  const auto family = [](double k1, double k2, double angle, double kappa) {
    GohParameters::Family f{{k1, k2}, angle, {}, {}, {}};
    f.kappa = kappa;
    return f;
  };
  GohParameters p;
  p.elastic.shear_modulus = 50e3;
  p.families = {family(20e3, 5.0, 0.6, 0.1), family(10e3, 0.0, -0.6, 0.2)};
  return p.law();
}
template <>
Fung example<Fung>() {
  return {30e3, {1.0, 0.8, 0.7}, {0.3, 0.2, 0.1}, {2.0, 2.5, 3.0}};
}
template <>
HolzapfelOgden example<HolzapfelOgden>() {
  return {20e3, 2.0, false, {{{18e3, 3.0}, {9e3, 2.0}}, {4e3, 5.0}, false}};
}
template <>
DiscreteFibreLaw example<DiscreteFibreLaw>() {
  DfdParameters p;
  p.elastic.shear_modulus = 50e3;
  p.rule = dfd::Octahedral{64};
  p.families.resize(2);
  p.families[0].energy = {20e3, 4.0};
  p.families[0].orientation = dfd::Bivariate{2.0, 10.0, 0.5};
  p.families[1].energy = {15e3, 0.0};
  p.families[1].orientation = dfd::Symmetric{3.0, -0.5, {}};
  return p.law();
}
template <>
test::ExponentialFibre example<test::ExponentialFibre>() {
  return {};
}

template <class Variant>
struct TypesOf;
template <class... L>
struct TypesOf<std::variant<L...>> {
  using Types = ::testing::Types<L..., test::ExponentialFibre>;  // the last one exercises the derived path
};

template <class L>
class WallLaw : public ::testing::Test {};
TYPED_TEST_SUITE(WallLaw, TypesOf<Law>::Types);

Mat3<double> some_gradient(std::mt19937& random, double size) {
  Mat3<double> F = identity<double>();
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> row = test::random_vector(random, size);
    for (int j = 0; j < 3; ++j) F(i, j) += row[j];
  }
  return F;
}

template <class T>
Symmetric<T> isochoric(const Mat3<T>& F) {
  return pow(determinant(F), -2.0 / 3.0) * right_cauchy_green(F);
}

/// With the part outside the isochoric split.
template <class L, class T>
T whole_energy(const L& law, const Mat3<T>& F) {
  T psi = law.energy(isochoric(F));
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) psi = psi + law.unsplit_energy(right_cauchy_green(F));
  return psi;
}

template <class L>
double scale_of(const L& law) {
  return law.shear_modulus_at_rest();
}

TYPED_TEST(WallLaw, ReferenceHasNoEnergyAndNoDeviatoricStress) {
  const TypeParam law = example<TypeParam>();
  const Symmetric<double> rest{{1, 1, 1, 0, 0, 0}};
  EXPECT_NEAR(law.energy(rest), 0.0, 1e-14 * scale_of(law));
  const Symmetric<double> S = stress(law, rest);
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(S[n] - (n < 3 ? trace(S) / 3.0 : 0.0), 0.0, 1e-12 * scale_of(law));
}

TYPED_TEST(WallLaw, ReferenceIsStiffAndShearModulusBoundsTheLeastStiffness) {
  const TypeParam law = example<TypeParam>();
  EXPECT_GT(law.shear_modulus_at_rest(), 0.0);
  const double h = 1e-4;  // isochoric shear with C12 = h: Psi = mu/2 h^2 or more
  Mat3<double> F = identity<double>();
  F(0, 1) = h;
  EXPECT_GE(whole_energy(law, F), 0.4999 * law.shear_modulus_at_rest() * h * h);
}

TYPED_TEST(WallLaw, EnergyIsObjective) {
  const TypeParam law = example<TypeParam>();
  std::mt19937 random(3);
  const double c = std::cos(0.9), s = std::sin(0.9);
  const Mat3<double> Q{{{c, -s, 0}, {0.6 * s, 0.6 * c, -0.8}, {0.8 * s, 0.8 * c, 0.6}}};
  for (int sample = 0; sample < 5; ++sample) {
    const Mat3<double> F = some_gradient(random, 0.2);
    const double psi = law.energy(isochoric(F));
    EXPECT_NEAR(law.energy(isochoric(Q * F)), psi, 1e-12 * (scale_of(law) + std::fabs(psi)));
  }
}

TYPED_TEST(WallLaw, FastPathEqualsDerivativesOfTheEnergy) {
  const TypeParam law = example<TypeParam>();
  std::mt19937 random(5);
  for (int sample = 0; sample < 10; ++sample) {
    const Symmetric<double> C = isochoric(some_gradient(random, 0.2));
    const Response<double> exact = derived_response([&](const auto& x) { return law.energy(x); }, C);
    const Symmetric<double> S = stress(law, C);
    const Symmetric<double> again = derived_stress([&](const auto& x) { return law.energy(x); }, C);
    const double size = scale_of(law) + std::sqrt(double_dot(exact.stress, exact.stress));
    for (int n = 0; n < 6; ++n) {
      EXPECT_NEAR(S[n], exact.stress[n], 1e-12 * size);
      EXPECT_NEAR(again[n], exact.stress[n], 1e-12 * size);
    }
    if constexpr (is_linear<TypeParam>) {
      for (double t : exact.tangent.v) EXPECT_EQ(t, 0.0);
    } else {
      const Response<double> fast = response(law, C);
      double largest = size;
      for (double t : exact.tangent.v) largest = std::max(largest, std::fabs(t));
      for (int n = 0; n < 6; ++n) EXPECT_NEAR(fast.stress[n], exact.stress[n], 1e-12 * size);
      for (int n = 0; n < 21; ++n) EXPECT_NEAR(fast.tangent.v[n], exact.tangent.v[n], 1e-12 * largest);
    }
  }
}

/// Differences of the energy, no dual numbers: guards the factors of the Voigt notation.
TYPED_TEST(WallLaw, StressAgainstDifferencesOfTheEnergy) {
  const TypeParam law = example<TypeParam>();
  std::mt19937 random(7);
  const Symmetric<double> C = isochoric(some_gradient(random, 0.2));
  const Symmetric<double> S = stress(law, C);
  Symmetric<double> dC;
  for (double& x : dC.v) x = test::random_vector(random, 1.0)[0];
  const double h = 1e-5;
  Symmetric<double> plus = C, minus = C;
  for (int n = 0; n < 6; ++n) plus[n] += h * dC[n], minus[n] -= h * dC[n];
  const double rate = (law.energy(plus) - law.energy(minus)) / (2 * h);
  EXPECT_NEAR(0.5 * double_dot(S, dC), rate, 1e-7 * (scale_of(law) + std::fabs(rate)));
}

/// The Cauchy stress of the kernels against dPsi/dF by dual numbers, through the whole isochoric split.
TYPED_TEST(WallLaw, CauchyStressIsTheDerivativeOfTheEnergyWithRespectToF) {
  const TypeParam law = example<TypeParam>();
  using D = Dual<double, 9>;
  std::mt19937 random(9);
  const double bulk = 10.0 * scale_of(law);
  for (VolumetricEnergy v : {VolumetricEnergy::simo_taylor, VolumetricEnergy::quadratic, VolumetricEnergy::miehe}) {
    const Body body{.density = 1.0, .volumetric = {v, bulk}};
    const ElementState<double> e = test::some_state(random);
    const Mat3<double> F = deformation_gradient(e);
    Mat3<D> Fd;
    for (int n = 0; n < 9; ++n) Fd(n / 3, n % 3) = D::variable(F(n / 3, n % 3), n);
    const D psi = whole_energy(law, Fd) + D(bulk) * body.volumetric.unit_energy(determinant(Fd));
    const Symmetric<double> sigma = displacement_cauchy_stress(e, law, body);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double PFt = 0.0;
        for (int k = 0; k < 3; ++k) PFt += psi.d[3 * i + k] * F(j, k);
        EXPECT_NEAR(sigma[voigt_index[i][j]], PFt / determinant(F), 1e-11 * bulk);
      }
  }
}

TYPED_TEST(WallLaw, PacksEqualScalars) {
  const TypeParam law = example<TypeParam>();
  std::mt19937 random(13);
  Symmetric<Pack<4>> batch;
  Symmetric<double> C[4];
  for (int l = 0; l < 4; ++l) {
    C[l] = isochoric(some_gradient(random, 0.2));
    for (int n = 0; n < 6; ++n) batch[n].set(l, C[l][n]);
  }
  const Symmetric<Pack<4>> S = stress(law, batch);
  for (int l = 0; l < 4; ++l)
    for (int n = 0; n < 6; ++n) EXPECT_NEAR(S[n][l], stress(law, C[l])[n], 1e-12 * scale_of(law));
}

/// By hand against the energy by dual numbers, at finite strains.
TEST(WallStVenantKirchhoff, StressAndTangentAreDerivativesOfTheEnergy) {
  const StVenantKirchhoff law{.shear_modulus = 3.0};
  std::mt19937 random(11);
  const Symmetric<double> C = right_cauchy_green(some_gradient(random, 0.3));
  const auto exact = derived_response([&](const auto& x) { return law.unsplit_energy(x); }, C);
  const auto fast = law.unsplit_response(C);
  for (int n = 0; n < 6; ++n) {
    EXPECT_NEAR(fast.stress[n], exact.stress[n], 1e-12);
    EXPECT_NEAR(law.unsplit_stress(C)[n], exact.stress[n], 1e-12);
  }
  for (int n = 0; n < 21; ++n) EXPECT_NEAR(fast.tangent.v[n], exact.tangent.v[n], 1e-12);
}

/// Uniaxial strain by lambda: S11 = 4/3 mu E11, Holzapfel (2000), (6.151) without the part of the bulk modulus.
TEST(WallStVenantKirchhoff, UniaxialStrain) {
  const StVenantKirchhoff law{.shear_modulus = 3.0};
  const double lambda = 1.3, E = 0.5 * (lambda * lambda - 1);
  EXPECT_NEAR(law.unsplit_stress(Symmetric<double>{{lambda * lambda, 1, 1, 0, 0, 0}})[0], 4.0 * E, 1e-13);
}

TEST(WallVolumetric, PressureAndStiffnessAreDerivativesOfTheEnergy) {
  using D = Dual<double, 1>;
  for (VolumetricEnergy v : {VolumetricEnergy::simo_taylor, VolumetricEnergy::quadratic, VolumetricEnergy::miehe}) {
    const Volumetric volumetric{v, 1.0};
    for (double J : {0.7, 1.0, 1.4}) {
      const D x = D::variable(J, 0);
      EXPECT_NEAR(volumetric.unit_energy(x).d[0], volumetric.unit_pressure(J), 1e-15);
      EXPECT_NEAR(volumetric.unit_pressure(x).d[0], volumetric.unit_stiffness(J), 1e-15);
    }
    EXPECT_EQ(volumetric.unit_energy(1.0), 0.0);
    EXPECT_EQ(volumetric.unit_pressure(1.0), 0.0);
    EXPECT_EQ(volumetric.unit_stiffness(1.0), 1.0);
  }
}

TEST(WallVolumetric, PublishedForms) {
  const double J = 1.2;
  EXPECT_NEAR((Volumetric{VolumetricEnergy::simo_taylor, 1}.unit_energy(J)), (J * J - 1 - 2 * std::log(J)) / 4, 1e-15);
  EXPECT_NEAR((Volumetric{VolumetricEnergy::quadratic, 1}.unit_energy(J)), 0.02, 1e-15);
  EXPECT_NEAR((Volumetric{VolumetricEnergy::miehe, 1}.unit_energy(J)), 0.2 - std::log(J), 1e-15);
  EXPECT_EQ(Volumetric{}.compressibility(), 0.0);
}

}  // namespace
}  // namespace tunica::wall
