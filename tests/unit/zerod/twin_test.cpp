// The 0D twin against the closed forms of the Windkessel, its balance of volume, and the search for its totals.
#include "tunica/zerod/twin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "text.hpp"
#include "tunica/base/error.hpp"

namespace tunica::zerod {
namespace {

constexpr double period = 0.8, mean_inflow = 8e-5, mmHg = 133.322387415, pi = std::numbers::pi;
const bc::Rcr rcr{.proximal = 1.2e7, .capacitance = 9e-9, .distal = 1.1e8, .distal_pressure = 500};

bc::Waveform sampled(const std::function<double(double)>& flow) {
  bc::Table table;
  for (int k = 0; k <= 1000; ++k) {
    table.times.push_back(period * k / 1000);
    table.values.push_back(flow(table.times.back()));
  }
  table.values.back() = table.values.front();
  return bc::Waveform::table(table, {});
}
/// A beat: half a sine, then nothing.
bc::Waveform heart(double scale = 1) {
  return sampled([scale](double t) {
    return t < 0.4 * period ? scale * mean_inflow * 2.5 * pi / 2 * std::sin(pi * t / (0.4 * period)) : 0.0;
  });
}

const Vessel rigid{0, {{0, 0}}};
const Vessel soft{2e-9, {{2e6, 1.2e5}, {1e6, 0.5e5}, {5e6, 2e5}}};
const FlowSplit three{.fractions = {0.2, 0.5, 0.3}, .distal_share = 0.9, .distal_pressure = 1000};
const Totals totals{.resistance = 1.5e8, .compliance = 9e-9};

TEST(ShareOut, OutletsSideBySideAreTheTotals) {
  const auto outlets = share_out(three, totals);
  double conductance = 0, compliance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& o = outlets[i];
    conductance += 1 / (o.proximal + o.distal);
    compliance += o.capacitance;
    // All fill and empty in the same time, and take their share of the flow.
    EXPECT_NEAR(o.distal * o.capacitance, 0.9 * totals.resistance * totals.compliance, 1e-12);
    EXPECT_NEAR(totals.resistance / (o.proximal + o.distal), three.fractions[i], 1e-14);
    EXPECT_EQ(o.distal_pressure, 1000);
  }
  EXPECT_NEAR(conductance * totals.resistance, 1, 1e-14);
  EXPECT_NEAR(compliance / totals.compliance, 1, 1e-14);
}

TEST(Twin, EmptiesIntoItsOutletAsAnExponential) {
  const Twin twin(rigid, {rcr}, bc::Waveform::constant(0), period);
  const auto cycle = twin.first_cycle({.time = 0, .pressure = 12e3, .flows = {0}, .stored = {12e3}});
  ASSERT_EQ(cycle.times.size(), 1000U);
  for (std::size_t k = 0; k < cycle.times.size(); ++k) {
    const double exact = 500 + 11500 * std::exp(-cycle.times[k] / (rcr.distal * rcr.capacitance));
    EXPECT_NEAR(cycle.pressure[k], exact, 1e-9 * exact);
  }
}

TEST(Twin, FillsWithASteadyFlow) {
  const double flow = 5e-5;
  const Twin twin(rigid, {rcr}, bc::Waveform::constant(flow), period);
  const auto cycle =
      twin.first_cycle({.time = 0, .pressure = 500 + rcr.proximal * flow, .flows = {flow}, .stored = {500}});
  for (std::size_t k = 0; k < cycle.times.size(); ++k) {
    const double filled = 1 - std::exp(-cycle.times[k] / (rcr.distal * rcr.capacitance));
    EXPECT_NEAR(cycle.pressure[k], 500 + flow * (rcr.proximal + rcr.distal * filled), 1e-7);
    EXPECT_NEAR(cycle.flows[0][k], flow, 1e-18);
  }
}

/// P = R_p Q + P_c, C dP_c/dt = Q - (P_c - P_d) / R_d for a flow Q0 + Q1 sin(w t).
TEST(Twin, OfOneOutletIsTheWindkesselOfAWave) {
  const double w = 2 * pi / period, tau = rcr.distal * rcr.capacitance, size = 0.6 * mean_inflow;
  const Twin twin(rigid, {rcr}, sampled([&](double t) { return mean_inflow + size * std::sin(w * t); }), period);
  const auto cycle = twin.periodic_cycle();
  for (std::size_t k = 0; k < cycle.times.size(); ++k) {
    const double t = cycle.times[k];
    const double stored = rcr.distal * size * (std::sin(w * t) - w * tau * std::cos(w * t)) / (1 + w * w * tau * tau);
    const double exact =
        500 + (rcr.proximal + rcr.distal) * mean_inflow + rcr.proximal * size * std::sin(w * t) + stored;
    EXPECT_NEAR(cycle.pressure[k], exact, 2e-6 * exact) << t;
  }
}

TEST(Twin, LosesNoVolume) {
  const auto outlets = share_out(three, totals);
  const Twin twin(soft, outlets, heart(), period);
  const auto cycle = twin.periodic_cycle();
  // Over a cycle as much leaves as comes in, and each outlet takes what its resistance lets pass of the mean pressure.
  const auto means = mean_flows(cycle);
  EXPECT_NEAR(std::accumulate(means.begin(), means.end(), 0.0) / heart().mean(), 1, 1e-6);
  const double mean = pressures(cycle).mean;
  for (std::size_t i = 0; i < 3; ++i) {
    const double resistance = soft.paths[i].resistance + outlets[i].proximal + outlets[i].distal;
    EXPECT_NEAR(means[i] * resistance / (mean - 1000), 1, 1e-6);
  }
  // At each instant the vessel keeps the rest: C_v dP/dt, second order backward.
  const double dt = period / 1000;
  for (std::size_t k = 2; k < cycle.times.size(); ++k) {
    const double rate = (1.5 * cycle.pressure[k] - 2 * cycle.pressure[k - 1] + 0.5 * cycle.pressure[k - 2]) / dt;
    double out = 0;
    for (const auto& flow : cycle.flows) out += flow[k];
    EXPECT_NEAR(heart().value(cycle.times[k]) - out, soft.compliance * rate, 1e-9 * mean_inflow);
  }
}

TEST(Twin, RepeatsItsCycle) {
  const Twin twin(soft, share_out(three, totals), heart(), period);
  const auto cycle = twin.periodic_cycle();
  const auto again = twin.first_cycle(cycle.end);
  EXPECT_EQ(cycle.end.time, 0);
  for (std::size_t k = 0; k < cycle.times.size(); ++k)  // its first step knows one past value only
    EXPECT_NEAR(again.pressure[k], cycle.pressure[k], 1e-3 * cycle.pressure[k]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(again.end.stored[i], cycle.end.stored[i], 1e-5 * cycle.end.stored[i]);
  // Outlets that take three hundred beats to fill do not take three hundred cycles to find, but are found.
  const auto slow =
      Twin(rigid, {{.proximal = 1e6, .capacitance = 2e-6, .distal = 1.1e8}}, heart(), period).periodic_cycle();
  EXPECT_NEAR(pressures(slow).mean / (1.11e8 * heart().mean()), 1, 1e-5);
}

/// Twice the flow makes twice the pressure above that of the far end.
TEST(Twin, IsLinear) {
  const auto one = Twin(soft, share_out(three, totals), heart(), period).periodic_cycle();
  const auto two = Twin(soft, share_out(three, totals), heart(2), period).periodic_cycle();
  for (std::size_t k = 0; k < one.times.size(); ++k) {
    EXPECT_NEAR(two.pressure[k] - 1000, 2 * (one.pressure[k] - 1000), 1e-6 * one.pressure[k]);
    EXPECT_NEAR(two.flows[1][k], 2 * one.flows[1][k], 1e-6 * mean_inflow);
  }
}

TEST(FindTotals, FindsThoseThatMadeThePressures) {
  for (const auto& vessel : {soft, Vessel{0, {{0, 0}, {0, 0}, {0, 0}}}}) {
    const auto p = pressures(Twin(vessel, share_out(three, totals), heart(), period).periodic_cycle());
    EXPECT_GT(p.systolic, p.mean);
    EXPECT_GT(p.mean, p.diastolic);
    const auto found = find_totals(three, vessel, heart(), period, p.systolic, p.diastolic);
    EXPECT_NEAR(found.resistance / totals.resistance, 1, 1e-4);
    EXPECT_NEAR(found.compliance / totals.compliance, 1, 1e-4);
  }
}

TEST(FindTotals, ScaleWithPressureAndFlow) {
  const FlowSplit split{.fractions = {0.4, 0.6}};
  const Vessel none{0, {{0, 0}, {0, 0}}};
  const auto usual = find_totals(split, none, heart(), period, 120 * mmHg, 80 * mmHg);
  const auto higher = find_totals(split, none, heart(), period, 180 * mmHg, 120 * mmHg);
  EXPECT_NEAR(higher.resistance / usual.resistance, 1.5, 1e-5);
  EXPECT_NEAR(higher.compliance / usual.compliance, 1 / 1.5, 1e-5);
  const auto more = find_totals(split, none, heart(3), period, 120 * mmHg, 80 * mmHg);
  EXPECT_NEAR(more.resistance / usual.resistance, 1.0 / 3, 1e-5);
  EXPECT_NEAR(more.compliance / usual.compliance, 3, 3e-5);
  // A larger pulse about the same middle asks for less compliance.
  EXPECT_LT(find_totals(split, none, heart(), period, 130 * mmHg, 70 * mmHg).compliance, 0.8 * usual.compliance);
}

TEST(FindTotals, SaysWhatCannotBeReached) {
  const Vessel none{0, {{0, 0}}};
  const auto why = [&](double distal_share, const Vessel& vessel, double systolic, double diastolic) {
    return test::message_of<SolverError>([&] {
      find_totals({.fractions = {1}, .distal_share = distal_share}, vessel, heart(), period, systolic * mmHg,
                  diastolic * mmHg);
    });
  };
  // With half of the resistance before the compliance the pulse is never as small as this.
  const auto small = why(0.5, none, 100, 95);
  EXPECT_NE(small.find("give 100/95 mmHg"), std::string::npos) << small;
  EXPECT_NE(small.find("raise `distal_share`"), std::string::npos) << small;
  // A vessel that takes up much of the beat leaves less of a pulse.
  EXPECT_NE(why(0.9, {5e-9, {{0, 0}}}, 170, 40).find("170/40 mmHg"), std::string::npos);
}

TEST(FirstPressures, TheDiastolicOneFollowsTheSystolicOne) {
  // It begins low, rises, falls to 70 and rises a little.
  const std::vector<double> times = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, p = {130, 60, 90, 120, 100, 70, 75};
  auto found = first_pressures(times, p, 95, 0.15);
  EXPECT_EQ(found.systolic, 120);
  EXPECT_EQ(found.diastolic, 70);
  EXPECT_EQ(found.mean, 95);
  EXPECT_EQ(first_pressures(times, p, 95, 0.0).systolic, 130);
  EXPECT_EQ(first_pressures(times, p, 95, 0.0).diastolic, 60);
  found = first_pressures(times, p, 95, 0.65);
  EXPECT_EQ(found.systolic, 75);
  EXPECT_EQ(found.diastolic, 75);
}

}  // namespace
}  // namespace tunica::zerod
