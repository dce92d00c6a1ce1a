// Laws with values to be found, what a law says in place of a measurement, and fits of tests whose law is known.
#include "tunica/fitting/fit.hpp"

#include <gtest/gtest.h>

#include "synthetic.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/fitting/uncertainty.hpp"
#include "tunica/fitting/vessel.hpp"

namespace tunica::fitting {
namespace {

LawTemplate law_of(const std::string& yaml) { return read_law(config::Document(yaml), "laws.test"); }

const std::string fibres =
    "material:\n"
    "  hgo:\n"
    "    shear_modulus: 20 kPa\n"
    "    poisson_ratio: 0.5\n"
    "    families:\n"
    "      - {k1: $k1, k2: 5, mean_angle: $angle}\n"
    "      - {k1: $k1, k2: 5, mean_angle: -$angle}\n"
    "parameters:\n"
    "  k1: {from: 1 kPa, to: 100 kPa, start: 30 kPa}\n"
    "  angle: {from: 0 deg, to: 90 deg}\n";

TEST(LawTemplate, OneParameterStandsInSeveralPlacesAndForItsOpposite) {
  const LawTemplate law = law_of(fibres);
  const std::vector<double> values{12e3, 0.5};
  const auto parameters = std::get<wall::HgoParameters>(law.at(values));
  EXPECT_DOUBLE_EQ(parameters.families[0].energy.k1, 12e3);
  EXPECT_DOUBLE_EQ(parameters.families[1].energy.k1, 12e3);
  EXPECT_DOUBLE_EQ(parameters.families[0].mean_angle, 0.5);
  EXPECT_DOUBLE_EQ(parameters.families[1].mean_angle, -0.5);
  EXPECT_EQ(law.key(0), "hgo.families[1].k1");
}

TEST(LawTemplate, ACopyHasValuesOfItsOwn) {
  const LawTemplate law = law_of(fibres);
  const LawTemplate copy = law;
  const std::vector<double> first{12e3, 0.5}, second{50e3, 0.1};
  copy.at(second);
  EXPECT_DOUBLE_EQ(std::get<wall::HgoParameters>(law.at(first)).families[1].energy.k1, 12e3);
  EXPECT_DOUBLE_EQ(std::get<wall::HgoParameters>(copy.at(second)).families[1].energy.k1, 50e3);
}

TEST(LawTemplate, NamesWithoutParameterAndParametersWithoutPlaceAreErrors) {
  EXPECT_THROW(law_of("material: {neo_hooke: {shear_modulus: $mu, poisson_ratio: 0.5}}\n"), InputError);
  EXPECT_THROW(law_of("material: {neo_hooke: {shear_modulus: 1 kPa, poisson_ratio: 0.5}}\n"
                      "parameters: {mu: {from: 1 kPa, to: 2 kPa}}\n"),
               InputError);
  EXPECT_THROW(law_of("material: {neo_hooke: {shear_modulus: $mu, poisson_ratio: 0.5}}\n"
                      "parameters: {mu: {from: 2 kPa, to: 1 kPa}}\n"),
               InputError);
}

TEST(LawTemplate, EveryStandardLawReads) {
  for (const std::string& name : standard_laws()) {
    const LawTemplate law = law_of(standard_law(name));
    std::vector<double> starts;
    for (const Parameter& p : law.parameters()) starts.push_back(p.start);
    EXPECT_NO_THROW(law.at(starts)) << name;
  }
}

/// The closed form of a sheet against Newton's method for all free components.
TEST(Predicted, ClosedFormOfASheetIsTheEquilibrium) {
  const wall::Law law = test::DispersedWall{}.law();
  const wall::FibreFrame axes = wall::ConstantFrame{}.frame();
  const wall::Volumetric incompressible;
  const auto at =
      wall::stretched(law, incompressible, axes, {1.15, 1.08}, wall::deformed(law, incompressible, identity<double>()));
  const auto S = wall::sheet_stress(law, axes, 1.15 * 1.15, 1.08 * 1.08, 0.0);
  ASSERT_TRUE(S);
  EXPECT_NEAR((*S)[0], at.state.stress[0], 1e-6 * at.state.stress[0]);
  EXPECT_NEAR((*S)[1], at.state.stress[1], 1e-6 * at.state.stress[1]);
}

TEST(Deviation, OfCurves) {
  const Deviation d = deviation({1.0, 2.0, 4.0}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(d.rms, std::sqrt(1.0 / 3.0), 1e-15);
  EXPECT_NEAR(*d.r_squared, 0.5, 1e-15);
  EXPECT_FALSE(deviation({1.0, 2.0}, {3.0, 3.0}).r_squared.has_value());
}

TEST(Fit, FindsTheLawThatMadeTheData) {
  const test::DispersedWall wall;
  const auto protocols = test::biaxial_protocols(wall.law(), 12, 90e3, {});
  Model model(law_of("material:\n"
                     "  dfd:\n"
                     "    shear_modulus: $mu\n"
                     "    poisson_ratio: 0.5\n"
                     "    directions: {product: {across: 10, around: 32}}\n"
                     "    families:\n"
                     "      - {k1: $k1, k2: $k2, bivariate_von_mises: {a: 2.9, b: 19.44, mean_angle: 38 deg}}\n"
                     "      - {k1: $k1, k2: $k2, bivariate_von_mises: {a: 2.9, b: 19.44, mean_angle: -38 deg}}\n"
                     "parameters:\n"
                     "  mu: {from: 1 kPa, to: 500 kPa, start: 20 kPa}\n"
                     "  k1: {from: 1 kPa, to: 500 kPa, start: 80 kPa}\n"
                     "  k2: {from: 0, to: 100, start: 5}\n"),
              protocols, std::nullopt, wall::VolumetricEnergy::simo_taylor);
  const Fit found = fit(model, {.starts = 1, .direction_tolerance = 0.002});
  const auto values = model.values(found.x);
  EXPECT_NEAR(values[0], 61e3, 61.0);
  EXPECT_NEAR(values[1], 34e3, 34.0);
  EXPECT_NEAR(values[2], 12.6, 0.0126);
  EXPECT_GT(*found.overall.r_squared, 0.99999);
}

TEST(Fit, ARefitFromBesideComesBack) {
  const wall::Law law = wall::make_law(wall::NeoHookeParameters{{.shear_modulus = 40e3, .poisson_ratio = 0.5}});
  const auto protocols = test::biaxial_protocols(law, 10, 50e3, {});
  const Model model(law_of(standard_law("neo_hooke")), protocols, std::nullopt, wall::VolumetricEnergy::simo_taylor);
  const auto targets = model.measured();
  const Residuals residuals = [&](std::span<const double> x, std::vector<double>& r) {
    return model.residuals(x, targets, r);
  };
  const Parameter& p = model.parameter(0);
  std::vector<double> beside{p.scaled(55e3)}, J = jacobian(residuals, beside);
  EXPECT_NEAR(p.value(refit(residuals, beside, J, 1e-12).x[0]), 40e3, 1.0);
}

/// Residuals of a fit are smaller and less alike than the noise: the estimate has to see through that.
TEST(Correlation, IsThatOfTheNoiseAndNotOfTheResiduals) {
  const wall::Law law = wall::make_law(wall::NeoHookeParameters{{.shear_modulus = 40e3, .poisson_ratio = 0.5}});
  double length = 0.0, lost = 0.0;
  constexpr int sets = 20;
  for (unsigned seed = 1; seed <= sets; ++seed) {
    const auto protocols = test::biaxial_protocols(law, 40, 50e3, {.stress = 500.0, .correlation = 0.8, .seed = seed});
    Model model(law_of(standard_law("neo_hooke")), protocols, std::nullopt, wall::VolumetricEnergy::simo_taylor);
    const Fit found = fit(model, {.starts = 1});
    length += found.correlation.length / sets;
    lost += found.correlation.lost_variance / sets;
  }
  EXPECT_NEAR(length, 9.0, 1.5);  // (1 + 0.8) / (1 - 0.8)
  EXPECT_LT(lost, 1.0);
  EXPECT_GT(lost, 0.9);
}

TEST(Correlation, BlocksCutIt) {
  const Correlation c{.share = 0.5, .length = 3.0, .lost_variance = 1.0};
  EXPECT_DOUBLE_EQ(c.length_in_blocks(1.0), 1.0);
  EXPECT_DOUBLE_EQ(c.length_in_blocks(2.0), 1.5);
  EXPECT_NEAR(c.length_in_blocks(4000.0), 3.0, 1e-2);
}

/// sigma = mu (lambda^2 - 1 / lambda^4) in equal biaxial tension.
TEST(Vessel, ModuliOfANeoHookeanSheet) {
  constexpr double mu = 40e3, stretch = 1.2;
  const wall::Law law = wall::make_law(wall::NeoHookeParameters{{.shear_modulus = mu, .poisson_ratio = 0.5}});
  const double square = stretch * stretch, inverse = 1.0 / (square * square), stress = mu * (square - inverse);
  const auto point = vessel_point(law, {stress, stress});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->stretch[0], stretch, 1e-8);
  EXPECT_NEAR(point->stretch[1], stretch, 1e-8);
  EXPECT_NEAR(point->moduli[0], 2.0 * mu * (square + inverse), 1.0);
  EXPECT_NEAR(point->moduli[1], point->moduli[0], 1.0);
  EXPECT_NEAR(point->moduli[2], 2.0 * mu * inverse, 1.0);
}

TEST(Vessel, ALawThatIsNotConvexIsFound) {
  const wall::Law soft = wall::make_law(wall::NeoHookeParameters{{.shear_modulus = 40e3, .poisson_ratio = 0.5}});
  EXPECT_FALSE(not_convex_at(soft, {1.5, 1.5}));
  const wall::Law softening = wall::make_law(wall::MooneyRivlinParameters{10e3, -5e3, {.poisson_ratio = 0.5}});
  EXPECT_FALSE(not_convex_at(softening, {1.05, 1.05}));
  const auto at = not_convex_at(softening, {1.6, 1.6});
  ASSERT_TRUE(at);
  // Equal stretch, a = ln lambda: c1 (8 exp 2a + 16 exp -4a) + c2 (16 exp 4a + 8 exp -2a) changes sign at 1.2.
  EXPECT_LT((*at)[0] * (*at)[1], 1.5 * 1.5);
}

/// F with shear in the plane against the equilibrium of the same specimen turned by its stretch.
TEST(Predicted, MeasuredGradients) {
  const wall::Law law = test::DispersedWall{}.law();
  Protocol sheet{.specimen = "s", .name = "p", .file = "f", .loading = Loading::biaxial};
  sheet.axes = wall::ConstantFrame{}.frame();
  sheet.second_stress = true;
  sheet.rows.push_back({.line = 1, .along = 1.15, .across = 1.08});
  Protocol measured = sheet;
  measured.loading = Loading::gradients;
  Mat3<double> F{};
  F(0, 0) = 1.15, F(1, 1) = 1.08, F(2, 2) = 0.8;  // the thickness is not used
  measured.rows[0].F = F;
  for (const auto measure : {wall::StressMeasure::cauchy, wall::StressMeasure::first_piola_kirchhoff,
                             wall::StressMeasure::second_piola_kirchhoff}) {
    sheet.measure = measured.measure = measure;
    const auto a = predicted(law, {}, sheet), b = predicted(law, {}, measured);
    ASSERT_EQ(b.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[k], b[k], 1e-9 * std::abs(a[k]));
  }
  // Simple shear by k of a neo-Hookean sheet: sigma11 = mu (1 + k^2 - 1), sigma22 = 0.
  const wall::Law soft = wall::make_law(wall::NeoHookeParameters{{.shear_modulus = 40e3, .poisson_ratio = 0.5}});
  F = identity<double>();
  F(0, 1) = 0.3;
  measured.rows[0].F = F;
  measured.measure = wall::StressMeasure::cauchy;
  const auto shear = predicted(soft, {}, measured);
  EXPECT_NEAR(shear[0], 40e3 * 0.09, 1e-6);
  EXPECT_NEAR(shear[1], 0.0, 1e-6);
  EXPECT_THROW(predicted(soft, {wall::VolumetricEnergy::simo_taylor, 1e6}, measured), InputError);
}

/// A worse law has residuals that are alike along all rows, and must not gain by counting for fewer.
TEST(Fit, CriteriaCountTheSameResidualsForEveryLaw) {
  const std::vector<double> values{30e3, 0.6};
  const wall::Law law = wall::make_law(law_of(fibres).at(values));
  const auto protocols = test::biaxial_protocols(law, 20, 90e3, {.stress = 300.0, .correlation = 0.3});
  std::vector<Fit> fits;
  for (const char* name : {"neo_hooke", "hgo"}) {
    Model model(law_of(standard_law(name)), protocols, std::nullopt, wall::VolumetricEnergy::simo_taylor);
    fits.push_back(fit(model, {.starts = 2}));
  }
  const auto both = criteria({&fits[0], &fits[1]});
  EXPECT_GT(fits[0].correlation.length, fits[1].correlation.length);
  EXPECT_NEAR(both[0].aic - both[1].aic,
              fits[1].effective_count() * std::log(fits[0].squares / fits[1].squares) - 2.0 * 3.0, 1e-9);
}

}  // namespace
}  // namespace tunica::fitting
