#include "tunica/bc/outlets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "folders.hpp"
#include "tunica/base/error.hpp"

namespace {

using namespace tunica::bc;
using tunica::InputError;

using std::numbers::pi;
constexpr Rcr typical{.proximal = 1.21e7, .capacitance = 1e-9, .distal = 1.212e8, .distal_pressure = 500.0};

TEST(Outlet, ResistanceFollowsTheInterpolatedFlow) {
  Outlet outlet("out", Resistance{.resistance = 1e8, .distal_pressure = 100.0});
  EXPECT_EQ(outlet.pressure(), 100.0);
  outlet.commit(0.1, 2e-6);
  EXPECT_DOUBLE_EQ(outlet.pressure(), 300.0);
  const auto p = outlet.evaluate(0.1, 0.75, 6e-6);
  EXPECT_DOUBLE_EQ(p.pressure, 100.0 + 1e8 * 5e-6);
  EXPECT_DOUBLE_EQ(p.per_end_flow, 0.75e8);
  EXPECT_DOUBLE_EQ(p.per_alpha_flow, 1e8);
}

TEST(Outlet, RcrSlopesAreTheDerivativesAndEvaluationChangesNothing) {
  for (const double dt : {1e-6, 1e-3, 0.04, 0.07, 1.0, 1e4}) {  // on both sides of the switch to the series
    Outlet outlet("out", typical);
    outlet.commit(0.01, 3e-5);
    const auto before = outlet.state();
    const auto p = outlet.evaluate(dt, 2.0 / 3, 8e-5), q = outlet.evaluate(dt, 2.0 / 3, 9e-5);  // linear in Q
    EXPECT_NEAR((q.pressure - p.pressure) / 1e-5, p.per_end_flow, 1e-9 * p.per_end_flow);
    const double alpha_flow = 3e-5 / 3 + 2.0 / 3 * 8e-5;
    EXPECT_NEAR(outlet.evaluate_at_alpha(dt, 2.0 / 3, alpha_flow).pressure, p.pressure, 1e-12 * p.pressure);
    EXPECT_DOUBLE_EQ(p.per_end_flow, 2.0 / 3 * p.per_alpha_flow);
    EXPECT_EQ(outlet.state(), before);
  }
}

TEST(Outlet, RcrIsExactForLinearFlowWhateverTheStep) {
  // One step of dt equals 1000 steps of dt/1000, and P(t_n + af dt) equals the end of a step of af dt.
  for (const double dt : {1e-3, 0.1, 3.0}) {
    Outlet one("out", typical), many("out", typical), part("out", typical);
    for (auto* o : {&one, &many, &part}) o->set_initial_flow(1e-5);
    one.commit(dt, 9e-5);
    for (int i = 1; i <= 1000; ++i) many.commit(dt / 1000, 1e-5 + 8e-5 * i / 1000);
    EXPECT_NEAR(one.pressure(), many.pressure(), 1e-10 * one.pressure());
    Outlet fresh("out", typical);
    fresh.set_initial_flow(1e-5);
    part.commit(0.6 * dt, 1e-5 + 0.6 * 8e-5);
    EXPECT_NEAR(fresh.evaluate(dt, 0.6, 9e-5).pressure, part.pressure(), 1e-12 * part.pressure());
  }
}

TEST(Outlet, RcrSatisfiesItsEquation) {
  // Central difference of P_c against (Q - (P_c - P_d)/R_d)/C in the middle of a step with linear flow.
  const double dt = 0.05, h = 1e-4;
  const auto stored = [&](double s) {
    Outlet o("out", typical);
    o.set_initial_flow(2e-5);
    o.commit(s, 2e-5 + 6e-5 * s / dt);
    return o.stored_pressure();
  };
  const double rate = (stored(0.02 + h) - stored(0.02 - h)) / (2 * h);
  const double flow = 2e-5 + 6e-5 * 0.02 / dt;
  EXPECT_NEAR(rate, (flow - (stored(0.02) - 500.0) / typical.distal) / typical.capacitance, 1e-4 * std::abs(rate));
}

TEST(Outlet, SteadyStateAndStiffStep) {
  const double flow = 5e-5, expected = 500.0 + flow * (typical.proximal + typical.distal);
  Outlet slow("out", typical);
  slow.set_initial_flow(flow);
  for (int i = 0; i < 300; ++i) slow.commit(0.01, flow);  // 3 s, time constant 0.12 s
  EXPECT_NEAR(slow.pressure(), expected, 1e-8 * expected);
  Outlet stiff("out", typical);
  for (int i = 0; i < 5; ++i) stiff.commit(1e6, flow);  // 8e6 time constants in a step: no ringing
  EXPECT_NEAR(stiff.pressure(), expected, 1e-6 * expected);
  stiff.commit(1e6, flow);
  EXPECT_NEAR(stiff.pressure(), expected, 1e-12 * expected);
}

TEST(Outlet, LimitsOfCapacitanceAndDistalResistance) {
  Rcr m = typical;
  m.capacitance = 1e-25;  // no storage: two resistances in series
  Outlet series("out", m);
  series.commit(1e-3, 5e-5);
  EXPECT_NEAR(series.pressure(), 500.0 + 5e-5 * (m.proximal + m.distal), 1e-9 * series.pressure());
  m = typical;
  m.capacitance = 1e3;  // a huge reservoir keeps P_c
  Outlet reservoir("out", m);
  reservoir.commit(1e-3, 5e-5);
  EXPECT_NEAR(reservoir.stored_pressure(), 500.0, 1e-9);
  m = typical;
  m.distal = 1e30;  // nothing leaves: P_c = P_d + volume / C, also where (1 - e^-z)/z would cancel
  Outlet closed("out", m);
  for (int i = 1; i <= 10; ++i) closed.commit(1e-3, 1e-6 * i);
  EXPECT_NEAR(closed.stored_pressure() - 500.0, 0.5 * 1e-2 * 1e-5 / m.capacitance, 1e-10);
}

TEST(Outlet, InitialPressureAndStateContinueBitForBit) {
  Rcr m = typical;
  EXPECT_EQ(Outlet("out", m).stored_pressure(), 500.0);
  m.initial_pressure = 9000.0;
  Outlet a("out", m);
  EXPECT_EQ(a.pressure(), 9000.0);
  const auto flow = [](int i) { return 1e-5 * std::sin(0.37 * i); };
  for (int i = 0; i < 50; ++i) a.commit(1.3e-3, flow(i));
  Outlet b("out", m);
  b.restore(a.state());
  for (int i = 50; i < 100; ++i) {
    EXPECT_EQ(a.evaluate(1.3e-3, 0.8, flow(i)).pressure, b.evaluate(1.3e-3, 0.8, flow(i)).pressure);
    a.commit(1.3e-3, flow(i));
    b.commit(1.3e-3, flow(i));
  }
  EXPECT_EQ(a.state(), b.state());
  const double wrong[] = {1.0, 2.0, 3.0};
  EXPECT_THROW(b.restore(wrong), InputError);
}

TEST(Outlet, RefusesBadParametersAllAtOnce) {
  try {
    Outlet("left_renal", Rcr{.proximal = -1.0, .capacitance = 0.0, .distal = std::nan("")});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3u);
    EXPECT_EQ(error.problems()[0].where, "boundary.left_renal");
  }
  EXPECT_THROW(Outlet("out", Resistance{.resistance = -1.0}), InputError);
}

// --- the periodic reference -------------------------------------------------------------------------------------

struct Reference {
  std::vector<double> t, q, p, pc;  // CGS
};

Reference read_reference(const std::filesystem::path& path) {
  Reference r;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    for (auto& c : line)
      if (c == ',') c = ' ';
    std::istringstream cells(line);
    double t, q, p, pc;
    cells >> t >> q >> p >> pc;
    r.t.push_back(t);
    r.q.push_back(q);
    r.p.push_back(p);
    r.pc.push_back(pc);
  }
  return r;
}

/// Largest relative error of P over the reference times, `steps` steps per reference interval.
double periodic_error(const Reference& r, int steps, double alpha_f) {
  Outlet outlet("out", Rcr{.proximal = 121, .capacitance = 1e-4, .distal = 1212, .initial_pressure = r.pc[0]});
  const auto flow = [](double t) { return 100 * (1 - std::cos(2 * pi * t)); };
  double error = 0.0;
  for (std::size_t i = 0; i + 1 < r.t.size(); ++i) {
    const double dt = (r.t[i + 1] - r.t[i]) / steps;
    for (int k = 0; k < steps; ++k) {
      if (alpha_f < 1 && k + 1 == steps) {
        // The response inside the step against the exact solution at that time.
        const double t = r.t[i] + (k + alpha_f) * dt, omega = 2 * pi, tau = 1212 * 1e-4;
        const double exact =
            121 * flow(t) + 1212 * 100 -
            1212 * 100 * (std::cos(omega * t) + omega * tau * std::sin(omega * t)) / (1 + omega * omega * tau * tau);
        const double p = outlet.evaluate(dt, alpha_f, flow(r.t[i] + (k + 1) * dt)).pressure;
        error = std::max(error, std::abs(p - exact) / exact);
      }
      outlet.commit(dt, flow(r.t[i] + (k + 1) * dt));
    }
    if (alpha_f == 1) error = std::max(error, std::abs(outlet.pressure() - r.p[i + 1]) / r.p[i + 1]);
  }
  return error;
}

TEST(Outlet, PeriodicReference) {
  const std::filesystem::path path = std::filesystem::path(TUNICA_SHARED_DATA) / "analytic/rcr_periodic.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const auto reference = read_reference(path);
  ASSERT_EQ(reference.t.size(), 41u);
  for (const double alpha_f : {1.0, 2.0 / 3}) {
    const double coarse = periodic_error(reference, 1, alpha_f), middle = periodic_error(reference, 2, alpha_f),
                 fine = periodic_error(reference, 4, alpha_f), target = periodic_error(reference, 5, alpha_f);
    printf("alpha_f %.3f: error of P at dt 25, 12.5, 6.25, 5 ms: %.2e %.2e %.2e %.2e, order %.2f\n", alpha_f, coarse,
           middle, fine, target, std::log2(middle / fine));
    EXPECT_LT(target, 1e-3);
    EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.2);
    EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.2);
  }
}

}  // namespace
