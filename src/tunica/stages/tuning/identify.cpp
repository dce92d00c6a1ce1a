#include "tunica/stages/tuning/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::stages {

namespace {

/// Steps at the start of a run that answer to the sudden onset rather than to the vessel.
constexpr std::size_t onset = 2;

double average(const Measured& run, const std::vector<double>& values, std::size_t from = 0) {
  double sum = 0, duration = 0;
  for (std::size_t k = from; k < values.size(); ++k) {
    sum += values[k] * run.durations[k];
    duration += run.durations[k];
  }
  return sum / duration;
}

double compliance(const Measured& run) {
  const double p = average(run, run.inlet_pressure, onset), v = average(run, run.lumen_volume, onset);
  double joint = 0, own = 0;
  for (std::size_t k = onset; k < run.times.size(); ++k) {
    joint += (run.lumen_volume[k] - v) * (run.inlet_pressure[k] - p);
    own += (run.inlet_pressure[k] - p) * (run.inlet_pressure[k] - p);
  }
  return own > 0 ? std::max(joint / own, 0.0) : 0.0;
}

/// Least squares of drop = R Q + L dQ/dt with R, L >= 0.
zerod::VesselPath path(const Measured& run, std::size_t outlet) {
  const auto& flow = run.outlet_flow[outlet];
  double qq = 0, qr = 0, rr = 0, dq = 0, dr = 0;
  for (std::size_t k = onset; k + 1 < run.times.size(); ++k) {
    const double q = flow[k], rate = (flow[k + 1] - flow[k - 1]) / (run.times[k + 1] - run.times[k - 1]),
                 drop = run.inlet_pressure[k] - run.outlet_pressure[outlet][k];
    qq += q * q, qr += q * rate, rr += rate * rate, dq += drop * q, dr += drop * rate;
  }
  const double det = qq * rr - qr * qr;
  if (det > 1e-12 * qq * rr) {
    const zerod::VesselPath both{(dq * rr - dr * qr) / det, (dr * qq - dq * qr) / det};
    if (both.resistance >= 0 && both.inertance >= 0) return both;
  }
  // One of them is at its bound: the other alone, whichever leaves less.
  const zerod::VesselPath resistance{qq > 0 ? std::max(dq / qq, 0.0) : 0, 0},
      inertance{0, rr > 0 ? std::max(dr / rr, 0.0) : 0};
  return resistance.resistance * dq >= inertance.inertance * dr ? resistance : inertance;
}

/// A table without holes, of as many steps as the other one.
void require_every_step(const files::CsvColumns& table, const files::CsvColumns& other, const char* remedy) {
  if (const auto breaks = artifacts::breaks_of(table); !breaks.empty())
    throw InputError(table.file.string(), breaks.front().what, remedy);
  if (table.column("step") != other.column("step"))
    throw InputError(table.file.string(), fmt::format("has not the steps of {}", other.file.string()), remedy);
}

}  // namespace

Measured read_measured(const std::filesystem::path& results, const case_file::Case& c, const std::string& inlet,
                       double until) {
  const auto& u = c.output.units;
  namespace dimension = config::dimension;
  const double time = config::unit_factor(u.time, dimension::time),
               flow = config::unit_factor(u.flow, dimension::volume_flow),
               pressure = config::unit_factor(u.pressure, dimension::pressure),
               length = config::unit_factor(u.length, dimension::length);
  const char* remedy = "it is a history of a tuning run: find the outlets anew, tunica tune CASE --overwrite";
  const files::CsvColumns faces = files::read_csv(results / "faces.csv", remedy),
                          balance = files::read_csv(results / "balance.csv", remedy),
                          of_steps = files::read_csv(results / "steps.csv", remedy);
  for (const auto* table : {&faces, &balance, &of_steps}) require_every_step(*table, faces, remedy);
  const auto times = faces.column(fmt::format("time [{}]", u.time));
  const auto steps =
      static_cast<std::size_t>(std::count_if(times.begin(), times.end(), [&](double t) { return t * time < until; }));
  const auto take = [&](const files::CsvColumns& table, const std::string& name, double factor) {
    std::vector<double> values = table.column(name);
    values.resize(steps);
    for (double& v : values) v *= factor;
    return values;
  };
  const auto of_face = [&](const std::string& face, const char* what, const std::string& unit, double factor) {
    return take(faces, fmt::format("{} {} [{}]", face, what, unit), factor);
  };
  Measured run{.times = take(faces, fmt::format("time [{}]", u.time), time),
               .durations = take(of_steps, fmt::format("dt [{}]", u.time), time),
               .inlet_pressure = of_face(inlet, "pressure", u.pressure, pressure),
               .lumen_volume = take(balance, fmt::format("lumen volume [{}^3]", u.length), length * length * length),
               .outlet_flow = {},
               .outlet_pressure = {}};
  for (const auto& [face, share] : c.outlets->fractions) {
    run.outlet_flow.push_back(of_face(face, "flow", u.flow, flow));
    run.outlet_pressure.push_back(of_face(face, "pressure", u.pressure, pressure));
  }
  return run;
}

zerod::Vessel identify(const Measured& run, bool rigid) {
  assert(run.times.size() > onset + 2);
  zerod::Vessel vessel{rigid ? 0.0 : compliance(run), {}};
  for (std::size_t i = 0; i < run.outlet_flow.size(); ++i) vessel.paths.push_back(path(run, i));
  return vessel;
}

zerod::TwinState start_of(const Measured& run, const zerod::Vessel& vessel, const std::vector<double>& stored) {
  zerod::TwinState start{run.times.front(), run.inlet_pressure.front(), {}, stored};
  if (vessel.compliance > 0)
    start.pressure = average(run, run.inlet_pressure, onset) +
                     (run.lumen_volume.front() - average(run, run.lumen_volume, onset)) / vessel.compliance;
  for (const auto& flow : run.outlet_flow) start.flows.push_back(flow.front());
  return start;
}

double settled(const Measured& run) { return run.times[onset]; }

zerod::Pressures first_pressures(const Measured& run) {
  return zerod::first_pressures(run.times, run.inlet_pressure, average(run, run.inlet_pressure), settled(run));
}

std::vector<double> mean_flows(const Measured& run) {
  std::vector<double> means;
  for (const auto& flow : run.outlet_flow) means.push_back(average(run, flow));
  return means;
}

}  // namespace tunica::stages
