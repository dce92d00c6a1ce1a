// Do 95 % intervals hold what they promise? Planar biaxial tests of a known law are made again and again with other
// noise, and each time the true values must lie in the intervals of the parameters that the tests identify.
//
//   TUNICA_FIT_SETS=100 build/ci/tests/verification_fitting
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "tunica/fitting/uncertainty.hpp"
#include "unit/fitting/synthetic.hpp"

namespace tunica {
namespace {

TEST(Coverage, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const char* wanted = std::getenv("TUNICA_FIT_SETS");
  const int sets = wanted ? std::max(1, std::atoi(wanted)) : 1;
  const test::DispersedWall wall;
  const std::vector<double> truth = wall.values();
  const auto law = fitting::read_law(config::Document(fitting::standard_law("dfd")), "dfd");
  std::vector<int> inside(truth.size(), 0), identified(truth.size(), 0), bootstrap(truth.size(), 0),
      profile(truth.size(), 0);
  double slowest = 0.0;
  for (int set = 0; set < sets; ++set) {
    const auto started = std::clock();
    const auto protocols = test::biaxial_protocols(
        wall.law(), 44, 95e3, {.stress = 700.0, .correlation = 0.8, .seed = 100u + static_cast<unsigned>(set)});
    fitting::Model model(law, protocols, std::nullopt, wall::VolumetricEnergy::simo_taylor);
    const fitting::Fit fit = fitting::fit(model, {.starts = 4});
    const double after_fit = static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC;
    const auto found = fitting::uncertainty(model, fit, {.replicates = 200, .seed = 7u + static_cast<unsigned>(set)});
    const double seconds = static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC;
    slowest = std::max(slowest, seconds);
    std::printf("set %d: fit %.2f s, all %.2f s, correlation length %.1f, block %zu, R2 %.5f, starts %zu", set,
                after_fit, seconds, fit.correlation.length, found.block, *fit.overall.r_squared, fit.agreeing_starts());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const fitting::Parameter& p = model.parameter(i);
      const fitting::Determination& d = found.unknowns[i];
      const double x = p.scaled(truth[i]);
      const auto holds = [&](const fitting::Interval& interval) { return x >= interval.low && x <= interval.high; };
      const bool in = holds(d.interval);
      if (d.identification == fitting::Identification::identified) {
        ++identified[i];
        inside[i] += in;
        bootstrap[i] += holds(d.bootstrap);
        profile[i] += holds(d.profile);
      }
      std::printf(" | %s %s [%s %s]%s p[%s %s] %s", p.name.c_str(), p.text(model.values(fit.x)[i], 3).c_str(),
                  p.text(p.value(d.bootstrap.low), 3).c_str(), p.text(p.value(d.bootstrap.high), 3).c_str(),
                  in ? "" : "!", p.text(p.value(d.profile.low), 3).c_str(), p.text(p.value(d.profile.high), 3).c_str(),
                  d.identification == fitting::Identification::identified ? "id"
                  : d.identification == fitting::Identification::weak     ? "weak"
                                                                          : "NOT");
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  for (std::size_t i = 0; i < truth.size(); ++i)
    std::printf("%s: identified in %d of %d, truth inside in %d (bootstrap alone %d, profile alone %d)\n",
                law.parameters()[i].name.c_str(), identified[i], sets, inside[i], bootstrap[i], profile[i]);
  std::printf("slowest %.2f s\n", slowest);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_GE(inside[i], 0.92 * identified[i]) << law.parameters()[i].name;
}

}  // namespace
}  // namespace tunica
