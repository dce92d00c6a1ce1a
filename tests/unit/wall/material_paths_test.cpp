// Specimens under load: free faces, closed forms, work, convergence.
#include "tunica/wall/material_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::wall {
namespace {

const FibreFrame along_e1 = specimen_axes({{1.0, 0.0, 0.0}});
const FibreFrame oblique = orthonormal_frame({{1.0, 0.5, 0.3}}, {{-0.4, 1.0, 0.2}}, "test");
const Volumetric no_change_of_volume;

Law neo_hooke() { return NeoHooke{50e3}; }

Law anisotropic(double k2 = 8.0) {
  DfdParameters p;
  p.elastic.shear_modulus = 50e3;
  p.rule = dfd::Octahedral{64};
  p.families.resize(2);
  p.families[0].energy = {40e3, k2};
  p.families[0].orientation = dfd::Symmetric{4.0, 0.6, {}};
  p.families[1].energy = {15e3, 2.0};
  p.families[1].orientation = dfd::Bivariate{2.0, 10.0, -0.4};
  return p.law();
}
Law unsplit() {
  auto law = std::get<DiscreteFibreLaw>(anisotropic());
  law.unsplit = true;
  return law;
}
Law fung() { return Fung{30e3, {1.0, 0.8, 0.7}, {0.3, 0.2, 0.1}, {2.0, 2.5, 3.0}}; }

PathPoint rest(const Law& law, const Volumetric& volumetric) { return deformed(law, volumetric, identity<double>()); }

TEST(MaterialPaths, ClosedFormsOfNeoHooke) {
  const double mu = 50e3, l = 1.3;
  const Law law = neo_hooke();
  const PathPoint start = rest(law, no_change_of_volume);
  EXPECT_NEAR(stretched(law, no_change_of_volume, along_e1, {l, {}}, start).state.cauchy[0], mu * (l * l - 1.0 / l),
              1e-6);
  const PathPoint equal = stretched(law, no_change_of_volume, along_e1, {l, l}, start);
  EXPECT_NEAR(equal.state.cauchy[0], mu * (l * l - std::pow(l, -4)), 1e-6);
  EXPECT_NEAR(equal.state.cauchy[1], equal.state.cauchy[0], 1e-6);
  const PathPoint planar = stretched(law, no_change_of_volume, along_e1, {l, 1.0}, start);
  EXPECT_NEAR(planar.state.cauchy[0], mu * (l * l - 1.0 / (l * l)), 1e-6);
  EXPECT_NEAR(planar.state.cauchy[1], mu * (1.0 - 1.0 / (l * l)), 1e-6);
  const PathPoint shear = sheared(law, no_change_of_volume, along_e1, 0.4);
  EXPECT_NEAR(shear.state.cauchy[3], 0.4 * mu, 1e-6);
  EXPECT_NEAR(shear.state.cauchy[0] - shear.state.cauchy[1], 0.16 * mu, 1e-6);
  EXPECT_NEAR(shear.state.cauchy[2], 0.0, 1e-6);
}

/// P a2 = P a3 = 0 or P a3 = 0, whatever the law and the axes; the volume is kept or belongs to the pressure.
TEST(MaterialPaths, FreeFacesBearNoTraction) {
  for (const Law& law : {neo_hooke(), anisotropic(), unsplit(), fung()})
    for (const Volumetric& volumetric :
         {no_change_of_volume, Volumetric{.bulk_modulus = 2e5}, Volumetric{VolumetricEnergy::miehe, 5e9}})
      for (const std::optional<double> across : {std::optional<double>{}, std::optional<double>{1.1}}) {
        const PathPoint p = stretched(law, volumetric, oblique, {1.25, across}, rest(law, volumetric));
        const double stress = norm(p.first_piola_kirchhoff * oblique.e1);
        EXPECT_GT(stress, 1e4);
        EXPECT_LT(norm(p.first_piola_kirchhoff * oblique.e3), 1e-9 * stress);
        if (!across) {
          EXPECT_LT(norm(p.first_piola_kirchhoff * oblique.e2), 1e-9 * stress);
        }
        EXPECT_NEAR(norm(p.F * oblique.e1), 1.25, 1e-12);
        EXPECT_NEAR(dot(p.F * oblique.e1, oblique.e1), 1.25, 1e-12) << "the first edge keeps its direction";
        if (across) {
          EXPECT_NEAR(norm(p.F * oblique.e2), *across, 1e-12);
          EXPECT_NEAR(dot(p.F * oblique.e1, p.F * oblique.e2), 0.0, 1e-12) << "no shear between the held edges";
        }
        EXPECT_NEAR(volumetric.unit_pressure(p.state.J) + p.pressure / volumetric.bulk_modulus, 0.0, 1e-11);
        EXPECT_NEAR(determinant(p.F), p.state.J, 1e-12);
      }
}

/// dPsi/dstretch = P11: free faces do no work, nor does the pressure of an no_change_of_volume law.
TEST(MaterialPaths, EnergyIsTheWorkOfTheLoad) {
  const double h = 1e-4;
  for (const Law& law : {anisotropic(), unsplit(), fung()})
    for (const Volumetric& volumetric : {no_change_of_volume, Volumetric{.bulk_modulus = 2e5}}) {
      const PathPoint at = stretched(law, volumetric, oblique, {1.15, {}}, rest(law, volumetric));
      const double slope = (stretched(law, volumetric, oblique, {1.15 + h, {}}, at).energy -
                            stretched(law, volumetric, oblique, {1.15 - h, {}}, at).energy) /
                           (2.0 * h);
      const double traction = dot(oblique.e1, at.first_piola_kirchhoff * oblique.e1);
      EXPECT_NEAR(slope / traction, 1.0, 1e-5);
    }
}

TEST(MaterialPaths, NewtonConvergesQuadratically) {
  const Law law = fung();  // smooth, so that nothing but the tangent decides
  for (const Volumetric& volumetric : {no_change_of_volume, Volumetric{.bulk_modulus = 5e9}}) {
    const PathPoint p = stretched(law, volumetric, oblique, {1.1, {}}, rest(law, volumetric));
    ASSERT_LE(p.residuals.size(), 7u);
    int tested = 0;
    for (std::size_t k = 1; k < p.residuals.size(); ++k)
      if (p.residuals[k - 1] < 0.05 && p.residuals[k] > 1e-13) {
        EXPECT_LT(p.residuals[k], 20.0 * p.residuals[k - 1] * p.residuals[k - 1]);
        ++tested;
      }
    EXPECT_GE(tested, 1);
  }
}

/// Newton's method alone does not get there from rest.
TEST(MaterialPaths, StiffFibresAreReachedInOneCall) {
  const Law law = anisotropic(60.0);
  const Volumetric finite{.bulk_modulus = 5e5};
  const PathPoint start = rest(law, finite);
  const PathPoint far = stretched(law, finite, along_e1, {1.7, {}}, start);
  PathPoint stepwise = start;
  for (int k = 1; k <= 70; ++k) stepwise = stretched(law, finite, along_e1, {1.0 + 0.01 * k, {}}, stepwise);
  EXPECT_NEAR(far.state.cauchy[0] / stepwise.state.cauchy[0], 1.0, 1e-8);
}

TEST(MaterialPaths, ShearedAndGivenStates) {
  const Law law = anisotropic();
  const PathPoint p = sheared(law, no_change_of_volume, oblique, 0.3);
  EXPECT_NEAR(dot(oblique.e3, p.state.cauchy * oblique.e3), 0.0, 1e-6) << "the third face bears no normal traction";
  EXPECT_GT(std::abs(dot(oblique.e2, p.state.cauchy * oblique.e2)), 1e3);
  EXPECT_NEAR(dot(oblique.e1, p.F * oblique.e2), 0.3, 1e-12);
  const Volumetric finite{.bulk_modulus = 2e5};
  EXPECT_EQ(sheared(law, finite, oblique, 0.3).pressure, 0.0);
  const Mat3<double> F{{{1.1, 0.1, 0.0}, {0.05, 0.9, 0.1}, {0.0, -0.1, 1.05}}};
  const auto expected = std::visit([&](const auto& l) { return material_point(F, l, finite); }, law);
  const PathPoint given = deformed(law, finite, F);
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(given.state.stress[n], expected.stress[n], 1e-9 * 2e5);
  for (int n = 0; n < 21; ++n) EXPECT_NEAR(given.state.tangent.v[n], expected.tangent.v[n], 1e-9 * 2e5);
}

/// Exponentials that are no numbers, or whose squares are none.
TEST(MaterialPaths, FailureIsAnError) {
  const struct {
    double k2;
    Stretches stretches;
  } cases[] = {{100.0, {8.0, {}}}, {8.0, {0.3, 1.1}}};
  for (const auto& c : cases) {
    const Law law = anisotropic(c.k2);
    try {
      stretched(law, no_change_of_volume, along_e1, c.stretches, rest(law, no_change_of_volume));
      FAIL() << "a stretch of " << c.stretches.along;
    } catch (const SolverError& error) {
      EXPECT_NE(std::string(error.what()).find("no equilibrium at a stretch of"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace tunica::wall
