// The 0D twin of the outlets against the impedance of its elements, and the search for its resistance and compliance.
#include "tunica/zerod/twin.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "tunica/base/error.hpp"
#include "tunica/stages/tuning/tuning_report.hpp"
#include "verification/fluid/tube.hpp"

namespace tunica::verification {
namespace {

using Complex = std::complex<double>;
constexpr double beat = 0.8, mean_inflow = 8e-5, omega_beat = 2 * std::numbers::pi / beat;
constexpr double mmHg = 133.322387415;

/// Q(t) = Q0 (1 - cos(omega t)), as a periodic spline.
bc::Waveform raised_cosine() {
  bc::Table table;
  for (int k = 0; k <= 400; ++k) {
    table.times.push_back(beat * k / 400);
    table.values.push_back(mean_inflow * (1 - std::cos(omega_beat * table.times.back())));
  }
  table.values.back() = table.values.front();
  return bc::Waveform::table(table, {.interpolation = bc::Interpolation::spline});
}

case_file::TuningCase two_outlets() {
  case_file::TuningCase outlets;
  outlets.systolic = 125 * mmHg;
  outlets.diastolic = 75 * mmHg;
  outlets.fractions = {{"a", 0.3}, {"b", 0.7}};
  return outlets;
}

const zerod::Totals totals{.resistance = 1.5e8, .compliance = 9e-9};
const zerod::Vessel soft{2e-9, {{2e6, 1.2e5}, {1e6, 0.5e5}}};

Complex impedance(const bc::Rcr& o, double w) {
  return o.proximal + o.distal / Complex(1, w * o.distal * o.capacitance);
}

/// Amplitude of the pressure at the inlet for an inflow of 1 m^3/s at the frequency w.
Complex inlet_impedance(const zerod::Vessel& vessel, const std::vector<bc::Rcr>& outlets, double w) {
  Complex admittance(0, w * vessel.compliance);
  for (std::size_t i = 0; i < outlets.size(); ++i)
    admittance +=
        1.0 / (vessel.paths[i].resistance + Complex(0, w * vessel.paths[i].inertance) + impedance(outlets[i], w));
  return 1.0 / admittance;
}

TEST(Twin, TotalsAreSharedOut) {
  const auto o = zerod::share_out(two_outlets().flow_split(), totals);
  EXPECT_NEAR(1 / (1 / (o[0].proximal + o[0].distal) + 1 / (o[1].proximal + o[1].distal)), totals.resistance, 1e-6);
  EXPECT_NEAR(o[0].capacitance + o[1].capacitance, totals.compliance, 1e-20);
  EXPECT_NEAR((o[1].proximal + o[1].distal) / (o[0].proximal + o[0].distal), 0.3 / 0.7, 1e-12);
  EXPECT_NEAR(o[1].capacitance / o[0].capacitance, 0.7 / 0.3, 1e-12);
  EXPECT_NEAR(o[0].distal / (o[0].proximal + o[0].distal), 0.9, 1e-12);
}

TEST(Twin, PeriodicStateIsThatOfTheImpedances) {
  for (const auto& vessel : {zerod::Vessel{0, {{0, 0}, {0, 0}}}, soft}) {
    const auto outlets = zerod::share_out(two_outlets().flow_split(), totals);
    const auto cycle = zerod::Twin(vessel, outlets, raised_cosine(), beat).periodic_cycle();
    const Complex z0 = inlet_impedance(vessel, outlets, 0), z1 = inlet_impedance(vessel, outlets, omega_beat);
    double worst = 0, largest = 0;
    for (std::size_t k = 0; k < cycle.times.size(); ++k) {
      const double exact = mean_inflow * (z0.real() - (z1 * std::exp(Complex(0, omega_beat * cycle.times[k]))).real());
      worst = std::max(worst, std::abs(cycle.pressure[k] - exact));
      largest = std::max(largest, std::abs(exact));
    }
    say("  twin, C_v = %.1e m^3/Pa: pressure at the inlet off by %.2e of the largest\n", vessel.compliance,
        worst / largest);
    EXPECT_LT(worst / largest, 2e-5);
    // A second cycle from its end is the same: it is periodic.
    const auto again = zerod::Twin(vessel, outlets, raised_cosine(), beat).first_cycle(cycle.end);
    EXPECT_NEAR(again.end.stored[0], cycle.end.stored[0], 1e-4 * cycle.end.stored[0]);
  }
}

// The reference of the outlets in 3D (CGS in the file).
TEST(Twin, FollowsTheClosedFormOfOneWindkessel) {
  const auto file = reference("rcr_periodic.csv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data";
  const auto table = read_columns(file);
  bc::Table inflow;
  for (int k = 0; k <= 400; ++k) {
    inflow.times.push_back(k / 400.0);
    inflow.values.push_back(1e-4 * (1 - std::cos(2 * std::numbers::pi * k / 400.0)));
  }
  inflow.values.back() = inflow.values.front();
  const bc::Rcr rcr{.proximal = 121e5, .capacitance = 1e-9, .distal = 1212e5};
  const auto cycle =
      zerod::Twin({0, {{0, 0}}}, {rcr}, bc::Waveform::table(inflow, {.interpolation = bc::Interpolation::spline}), 1.0)
          .periodic_cycle();
  double worst = 0, largest = 0;
  for (std::size_t row = 1; row + 1 < table["t"].size(); ++row) {
    const auto k = static_cast<std::size_t>(std::lround(table["t"][row] * 1000)) - 1;
    worst = std::max(worst, std::abs(cycle.pressure[k] - 0.1 * table["P_dyn_cm2"][row]));
    largest = std::max(largest, 0.1 * table["P_dyn_cm2"][row]);
  }
  say("  twin against the closed form of a Windkessel: off by %.2e of the largest pressure\n", worst / largest);
  EXPECT_LT(worst / largest, 1e-5);
}

// A cycle that starts from steady flow dips where the inflow jumps to that of the end of diastole.
TEST(Twin, TheDipAtTheStartIsNotTheDiastolicPressure) {
  const auto cycle =
      zerod::Twin(soft, zerod::share_out(two_outlets().flow_split(), totals), raised_cosine(), beat).periodic_cycle();
  stages::TuningCycle tuning;
  tuning.first = tuning.periodic = cycle;
  for (std::size_t k = 0; k < cycle.times.size(); ++k) {
    tuning.run.times.push_back(cycle.times[k]);
    tuning.run.durations.push_back(beat / static_cast<double>(cycle.times.size()));
    tuning.run.inlet_pressure.push_back(cycle.pressure[k] - 20 * mmHg * std::exp(-cycle.times[k] / 0.02));
  }
  const zerod::Pressures periodic = zerod::pressures(cycle), foreseen = tuning.foreseen();
  EXPECT_LT(tuning.run.inlet_pressure.front(), periodic.diastolic - 10 * mmHg);
  EXPECT_NEAR(foreseen.diastolic, periodic.diastolic, 1e-9 * periodic.diastolic);
  EXPECT_NEAR(foreseen.systolic, periodic.systolic, 1e-9 * periodic.systolic);
}

TEST(Twin, TotalsMeetTheTargets) {
  const auto asked = two_outlets();
  for (const auto& vessel : {zerod::Vessel{0, {{0, 0}, {0, 0}}}, soft}) {
    const auto found =
        zerod::find_totals(asked.flow_split(), vessel, raised_cosine(), beat, asked.systolic, asked.diastolic);
    const auto p = zerod::pressures(
        zerod::Twin(vessel, zerod::share_out(asked.flow_split(), found), raised_cosine(), beat).periodic_cycle());
    say("  R_T %.4e Pa s/m^3, C_T %.4e m^3/Pa: %.4f/%.4f mmHg, mean %.2f\n", found.resistance, found.compliance,
        p.systolic / mmHg, p.diastolic / mmHg, p.mean / mmHg);
    EXPECT_NEAR(p.systolic, asked.systolic, 1e-5 * asked.systolic);
    EXPECT_NEAR(p.diastolic, asked.diastolic, 1e-5 * asked.diastolic);
  }
}

// With half of the resistance before the compliance the pulse cannot fall below what that half makes of the flow.
TEST(Twin, SaysThatTargetsAreOutOfReach) {
  auto asked = two_outlets();
  asked.distal_share = 0.5;
  asked.systolic = 80 * mmHg;
  try {
    zerod::find_totals(asked.flow_split(), {0, {{0, 0}, {0, 0}}}, raised_cosine(), beat, asked.systolic,
                       asked.diastolic);
    FAIL() << "totals were found";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("distal_share"), std::string::npos) << error.what();
  }
}

TEST(Twin, VesselIsIdentifiedFromItsHistories) {
  stages::Measured run;
  run.outlet_flow.resize(2);
  run.outlet_pressure.resize(2);
  const double w = omega_beat;
  for (int k = 0; k < 60; ++k) {
    const double t = 0.004 * k, p = 1e4 + 2e3 * std::sin(w * t);
    run.times.push_back(t);
    run.durations.push_back(0.004);
    run.inlet_pressure.push_back(p);
    run.lumen_volume.push_back(1e-4 + soft.compliance * p);
    for (std::size_t i = 0; i < 2; ++i) {
      const double q = 4e-5 * (1.5 + std::cos(w * t + static_cast<double>(i))),
                   rate = -4e-5 * w * std::sin(w * t + static_cast<double>(i));
      run.outlet_flow[i].push_back(q);
      run.outlet_pressure[i].push_back(p - soft.paths[i].resistance * q - soft.paths[i].inertance * rate);
    }
  }
  const auto found = stages::identify(run, false);
  EXPECT_NEAR(found.compliance, soft.compliance, 1e-9 * soft.compliance);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(found.paths[i].resistance, soft.paths[i].resistance, 2e-3 * soft.paths[i].resistance);
    EXPECT_NEAR(found.paths[i].inertance, soft.paths[i].inertance, 2e-3 * soft.paths[i].inertance);
  }
  EXPECT_EQ(stages::identify(run, true).compliance, 0);
}

}  // namespace
}  // namespace tunica::verification
