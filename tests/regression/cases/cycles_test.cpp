// Runs in cycles until they are periodic, and steps whose size follows the error.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"
#include "tunica/bc/outlets.hpp"

namespace tunica::test {
namespace {

constexpr double period = 0.5;  // s

/// A rigid tube with a raised cosine of inflow into a Windkessel whose time constant is 0.1 s.
std::string pulsating_case(const std::string& time) {
  return "analysis: flow\nelements: linear\nmeshes: {tube: {" + coarse_tube +
         "}}\n"
         "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\nboundary:\n"
         "  lumen_inlet: {flow: {table: {file: inflow.csv, time_unit: s, unit: ml/s, interpolation: spline}}}\n"
         "  lumen_outlet: {rcr: {proximal: 1e7 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e8 Pa s/m^3}}\n"
         "  lumen_wall: no_slip\ntime: {" +
         time + "}\nnewton: {relative_tolerance: 1e-8}\noutput: {every: 50, checkpoint_every: 25}\n";
}

std::string pulsating_inflow() {
  std::string text = "t,Q\n";
  for (int k = 0; k <= 100; ++k)
    text += fmt::format("{:.6f},{:.9f}\n", period * k / 100, 10 * (1 - std::cos(2 * std::numbers::pi * k / 100)));
  return text;
}

/// Pressure of the outlet in the periodic state [mmHg].
double exact_pressure(double t) {
  const double w = 2 * std::numbers::pi / period, q = 1e-5, rp = 1e7, rd = 1e8, rc = 0.1, a = 1 + w * w * rc * rc;
  // Q = q (1 - cos wt); P_c = rd q [1 - (cos wt + w rc sin wt) / a]
  const double stored = rd * q * (1 - (std::cos(w * t) + w * rc * std::sin(w * t)) / a);
  return (stored + rp * q * (1 - std::cos(w * t))) / 133.322387415;
}

TEST(Cycles, EndWhenTheyRepeatThemselves) {
  const SharedFolder folder;
  folder.write("inflow.csv", pulsating_inflow());
  const auto file =
      folder.write("case.yaml", pulsating_case("step: 10 ms, cycles: {period: 0.5 s, most: 6, tolerance: 0.2 %}"));
  const std::string printed = run(file);
  // The state decays by exp(-5) from cycle to cycle, so that the third repeats the second to 0.7 %.
  const Table cycles(folder.path() / "results/cycles.csv");
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    for (std::size_t k = 0; k < cycles["cycle"].size(); ++k)
      std::printf("cycle %g: pressure changes by %.2e, flow by %.2e\n", cycles["cycle"][k],
                  cycles["pressure change"][k], cycles["flow change"][k]);
    EXPECT_NE(printed.find("periodic"), std::string::npos) << printed;
  }
  EXPECT_LT(cycles.last("pressure change"), 2e-3);
  EXPECT_GT(cycles["pressure change"][cycles["cycle"].size() - 2], 2e-3);
  EXPECT_LT(cycles["cycle"].size(), 6u);
  EXPECT_EQ(Table(folder.path() / "results/steps.csv")["step"].size(), 50 * cycles["cycle"].size());
  const Table outlets(folder.path() / "results/outlets.csv");
  const double p = outlets.last("lumen_outlet pressure [mmHg]");
  EXPECT_NEAR(p, exact_pressure(outlets.last("time [s]")), 5e-3 * exact_pressure(0.25));
  stages::RunRequest again;
  again.restart = true;
  const std::string more = run(file, again);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(more.find("the run is periodic"), std::string::npos) << more;
  }
}

TEST(Cycles, RestartGoesOnBitForBit) {
  const SharedFolder folder;
  folder.write("inflow.csv", pulsating_inflow());
  const auto file = folder.write(
      "case.yaml",
      pulsating_case("step: 10 ms, cycles: {period: 0.5 s, most: 3, tolerance: 1e-6}, adaptive: {tolerance: 1e-2, "
                     "smallest: 1 ms}"));
  stages::RunRequest request;
  request.directory = folder.path() / "whole";
  const std::string printed = run(file, request);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(printed.find("not yet periodic"), std::string::npos) << printed;
  }
  request.directory = folder.path() / "parts";
  for (const int until : {70, 100}) {
    request.until = until;
    run(file, request);
    request.restart = true;
  }
  request.until.reset();
  run(file, request);
  for (const char* name : {"checkpoints/step_00000150.checkpoint", "cycles.csv", "faces.csv"})
    EXPECT_TRUE(slurp(folder.path() / "whole" / name) == slurp(folder.path() / "parts" / name)) << name;
}

TEST(Cycles, PeriodMustFit) {
  const SharedFolder folder;
  folder.write("inflow.csv", pulsating_inflow());
  const auto problems = [&](const std::string& time) {
    try {
      run(folder.write("case.yaml", pulsating_case(time)));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(problems("step: 3 ms, cycles: {period: 0.5 s}").find("no multiple of the step"), std::string::npos);
  EXPECT_NE(problems("step: 10 ms, cycles: {period: 0.8 s}").find("no multiple of the period"), std::string::npos);
  EXPECT_NE(problems("step: 10 ms, steps: 3, cycles: {period: 0.5 s}").find("beside `steps`"), std::string::npos);
  EXPECT_NE(problems("step: 10 ms").find("time.steps"), std::string::npos);
}

/// Largest difference of the outlet's pressure from the exact one in the second cycle, of the largest pressure; and the
/// number of steps.
std::pair<double, std::size_t> accuracy(const SharedFolder& folder, const std::string& name, const std::string& time) {
  stages::RunRequest request;
  request.directory = folder.path() / name;
  run(folder.write(name + ".yaml", pulsating_case(time)), request);
  const Table outlets(folder.path() / name / "outlets.csv");
  const auto &t = outlets["time [s]"], &p = outlets["lumen_outlet pressure [mmHg]"];
  double worst = 0;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] > 4 * period) worst = std::max(worst, std::abs(p[k] - exact_pressure(t[k])) / exact_pressure(0.25));
  return {worst, t.size()};
}

TEST(AdaptiveSteps, ErrorFollowsTheTolerance) {
  if (parallel::size(MPI_COMM_WORLD) > 1) GTEST_SKIP() << "a property of the scheme, whatever the ranks";
  const SharedFolder folder;
  folder.write("inflow.csv", pulsating_inflow());
  std::vector<double> errors;
  for (const char* tolerance : {"4e-2", "1e-2", "2.5e-3"}) {
    const auto [error, steps] =
        accuracy(folder, fmt::format("adaptive_{}", tolerance),
                 fmt::format("step: 50 ms, steps: 50, adaptive: {{tolerance: {}, smallest: 1 ms}}", tolerance));
    errors.push_back(error);
    if (parallel::rank(MPI_COMM_WORLD) == 0)
      std::printf("tolerance %s: %zu steps, error %.2e\n", tolerance, steps, error);
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
  EXPECT_LT(errors[2], 0.6 * errors[1]);
}

/// Inflow of a tenth of a second, rest for nine.
double pulse(double t) { return t < 0.1 ? 50 * (1 - std::cos(20 * std::numbers::pi * t)) : 0.0; }

std::string pulse_table() {
  std::string text = "t,Q\n";
  for (int k = 0; k <= 2000; ++k) text += fmt::format("{:.6f},{:.9f}\n", k / 2000.0, pulse(k / 2000.0));
  return text;
}

/// Pressure of the Windkessel at the end of each time [mmHg], by steps of 10 us.
std::vector<double> fine_pressure(const std::vector<double>& times) {
  bc::Outlet outlet("outlet", bc::Rcr{.proximal = 1e7, .capacitance = 1e-9, .distal = 1e8});
  std::vector<double> pressure;
  std::int64_t n = 0;
  for (const double t : times) {
    for (; static_cast<double>(n + 1) * 1e-5 <= t + 1e-9; ++n)
      outlet.commit(1e-5, 1e-6 * pulse(static_cast<double>(n + 1) * 1e-5));
    pressure.push_back(outlet.pressure() / 133.322387415);
  }
  return pressure;
}

TEST(AdaptiveSteps, SaveStepsWhereNothingHappens) {
  if (parallel::size(MPI_COMM_WORLD) > 1) GTEST_SKIP() << "a property of the scheme, whatever the ranks";
  const SharedFolder folder;
  folder.write("inflow.csv", pulse_table());
  const auto measure = [&](const std::string& name, const std::string& time) {
    stages::RunRequest request;
    request.directory = folder.path() / name;
    run(folder.write(name + ".yaml", pulsating_case(time)), request);
    const Table outlets(folder.path() / name / "outlets.csv");
    const auto exact = fine_pressure(outlets["time [s]"]);
    const auto& p = outlets["lumen_outlet pressure [mmHg]"];
    double worst = 0;
    for (std::size_t k = 0; k < p.size(); ++k) worst = std::max(worst, std::abs(p[k] - exact[k]));
    return std::pair{worst / *std::max_element(exact.begin(), exact.end()), static_cast<double>(p.size())};
  };
  const auto [fixed_error, fixed_steps] = measure("fixed", "step: 5 ms, steps: 200");
  const auto [error, steps] =
      measure("adaptive", "step: 50 ms, steps: 20, adaptive: {tolerance: 5e-3, smallest: 0.5 ms}");
  // The error of fixed steps falls with their square.
  const double as_good = fixed_steps * std::sqrt(fixed_error / error);
  if (parallel::rank(MPI_COMM_WORLD) == 0)
    std::printf("fixed: %g steps, error %.2e; adaptive: %g steps, error %.2e, as good as %.0f fixed ones\n",
                fixed_steps, fixed_error, steps, error, as_good);
  EXPECT_LT(error, fixed_error);
  EXPECT_LT(steps, 0.6 * as_good);
}

}  // namespace
}  // namespace tunica::test
