// Chronic dissection, adventitia, planar biaxial tests with five protocols: second Piola-Kirchhoff stress of 81/80 kPa
// was measured at Green-Lagrange strains 0.172/0.203, 77/45 at 0.214/0.066 and 43/77 at 0.065/0.248. Dispersed fibres
// with mu 61 kPa, k1 34 kPa, k2 12.6, +-38 deg, a 2.9 were published for the five with R^2 0.987, GOH with 0.969,
// neo-Hooke with 0.905. With the density of directions as it is normalised here these states ask for a third of that
// k1.
//
// The rows before the ends are not published. Here strain grows in proportion up to the measured one, stress is that of
// the law, scaled so that it ends at the measured one, and the two protocols without published ends lie between.
#include <gtest/gtest.h>

#include <cstdio>

#include "tunica/fitting/uncertainty.hpp"
#include "unit/fitting/synthetic.hpp"

namespace tunica {
namespace {

using Pair = std::array<double, 2>;
struct State {
  Pair strain, stress;  ///< E11, E22; S11, S22 [kPa]
};
constexpr std::array<State, 3> measured{
    {{{0.172, 0.203}, {81, 80}}, {{0.214, 0.066}, {77, 45}}, {{0.065, 0.248}, {43, 77}}}};

/// [Pa]
Pair second_piola_kirchhoff(const wall::Law& law, const Pair& strain) {
  const auto S =
      wall::sheet_stress(law, wall::ConstantFrame{}.frame(), 1.0 + 2.0 * strain[0], 1.0 + 2.0 * strain[1], 0.0);
  return {(*S)[0], (*S)[1]};
}

/// Measured stress over that of the law.
Pair scale_at(const wall::Law& law, const State& state) {
  const Pair S = second_piola_kirchhoff(law, state.strain);
  return {1e3 * state.stress[0] / S[0], 1e3 * state.stress[1] / S[1]};
}

Pair between(const Pair& a, const Pair& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

std::vector<fitting::Protocol> protocols(const wall::Law& law) {
  std::vector<std::pair<Pair, Pair>> ends;  // strain, scale
  for (const State& s : measured) ends.emplace_back(s.strain, scale_at(law, s));
  for (const std::size_t k : {1, 2})
    ends.emplace_back(between(ends[0].first, ends[k].first), between(ends[0].second, ends[k].second));
  constexpr std::size_t rows = 30;
  const test::Noise noise{.stress = 1000.0, .correlation = 0.8};
  std::mt19937 random(noise.seed);
  std::vector<fitting::Protocol> all;
  for (const auto& [strain, scale] : ends) {
    fitting::Protocol p{.specimen = "adventitia", .name = std::to_string(all.size() + 1), .file = "none"};
    p.loading = fitting::Loading::biaxial;
    p.axes = wall::ConstantFrame{}.frame();
    p.measure = wall::StressMeasure::second_piola_kirchhoff;
    p.second_stress = true;
    p.test = "biaxial";
    const auto along = test::correlated(rows, noise, random), across = test::correlated(rows, noise, random);
    for (std::size_t i = 0; i < rows; ++i) {
      const double share = static_cast<double>(i + 1) / rows;
      const Pair E{share * strain[0], share * strain[1]}, S = second_piola_kirchhoff(law, E);
      p.rows.push_back({.line = static_cast<int>(i) + 2,
                        .along = std::sqrt(1.0 + 2.0 * E[0]),
                        .across = std::sqrt(1.0 + 2.0 * E[1]),
                        .stress = {scale[0] * S[0] + along[i], scale[1] * S[1] + across[i]}});
    }
    all.push_back(std::move(p));
  }
  return all;
}

TEST(Published, LawsAreRankedAsPublished) {
  const auto data = protocols(test::DispersedWall{.k1 = 34.0 / 3.0}.law());
  std::vector<fitting::Fit> fits;
  for (const char* name : {"dfd", "goh", "neo_hooke"}) {
    fitting::Model model(fitting::read_law(config::Document(fitting::standard_law(name)), name), data, std::nullopt,
                         wall::VolumetricEnergy::simo_taylor);
    const fitting::Fit& fit = fits.emplace_back(fitting::fit(model, {.starts = 4}));
    std::printf("%s: R2 %.4f", name, *fit.overall.r_squared);
    const auto values = model.values(fit.x);
    for (std::size_t i = 0; i < values.size(); ++i)
      std::printf(", %s %s", model.parameter(i).name.c_str(), model.parameter(i).text(values[i], 3).c_str());
    std::printf("\n");
    const wall::Law law = model.make_law(model.parameters_of("adventitia", fit.x));
    for (const State& s : measured) {
      const Pair S = second_piola_kirchhoff(law, s.strain);
      std::printf("  E %.3f/%.3f: S %.1f/%.1f kPa, measured %.0f/%.0f\n", s.strain[0], s.strain[1], 1e-3 * S[0],
                  1e-3 * S[1], s.stress[0], s.stress[1]);
    }
    if (fits.size() > 1) continue;
    const auto found = fitting::uncertainty(model, fit, {.replicates = 40});
    EXPECT_EQ(found.unknowns.back().identification, fitting::Identification::not_identified) << "b";
  }
  EXPECT_GE(*fits[0].overall.r_squared, 0.985);
  const auto criteria = fitting::criteria({&fits[0], &fits[1], &fits[2]});
  EXPECT_LT(criteria[0].bic, criteria[1].bic);
  EXPECT_LT(criteria[1].bic, criteria[2].bic);
}

}  // namespace
}  // namespace tunica
