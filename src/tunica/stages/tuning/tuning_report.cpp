#include "tunica/stages/tuning/tuning_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"

namespace tunica::stages {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* tuning_report_file = "tuning.json";

ordered_json json_of(const zerod::Pressures& p) {
  return {{"systolic_Pa", p.systolic}, {"diastolic_Pa", p.diastolic}, {"mean_Pa", p.mean}};
}

ordered_json json_of(const zerod::Vessel& vessel, const case_file::TuningCase& outlets) {
  ordered_json json{{"compliance_m3_Pa", vessel.compliance}};
  for (std::size_t i = 0; i < vessel.paths.size(); ++i)
    json["paths"][outlets.fractions[i].first] = {{"resistance_Pa_s_m3", vessel.paths[i].resistance},
                                                 {"inertance_Pa_s2_m3", vessel.paths[i].inertance}};
  return json;
}

ordered_json json_of(const TuningCycle& cycle, const case_file::TuningCase& outlets) {
  ordered_json json{{"total_resistance_Pa_s_m3", cycle.totals.resistance},
                    {"total_compliance_m3_Pa", cycle.totals.compliance},
                    {"measured", json_of(cycle.measured())},
                    {"0D_from_the_same_start", json_of(cycle.foreseen_first())},
                    {"0D_periodic", json_of(zerod::pressures(cycle.periodic))},
                    {"foreseen", json_of(cycle.foreseen())},
                    {"relative_miss", cycle.miss(outlets)},
                    {"vessel", json_of(cycle.vessel, outlets)}};
  for (std::size_t i = 0; i < cycle.fractions.size(); ++i)
    json["fractions"][outlets.fractions[i].first] = cycle.fractions[i];
  return json;
}

ordered_json outlets_json(const TuningCycle& cycle, const case_file::TuningCase& outlets) {
  ordered_json json;
  const auto shared = zerod::share_out(outlets.flow_split(), cycle.totals);
  for (std::size_t i = 0; i < shared.size(); ++i)
    json[outlets.fractions[i].first] = {{"proximal_Pa_s_m3", shared[i].proximal},
                                        {"capacitance_m3_Pa", shared[i].capacitance},
                                        {"distal_Pa_s_m3", shared[i].distal},
                                        {"initial_pressure_Pa", cycle.periodic.end.stored[i]}};
  return json;
}

void write_json(const TuningReport& report, const case_file::TuningCase& outlets) {
  ordered_json json;
  json["program"] = {{"version", report.program.version}, {"commit", report.program.commit}};
  json["inputs"] = artifacts::to_json(report.inputs);
  json["status"] = report.status;
  json["targets"] = json_of(zerod::Pressures{outlets.systolic, outlets.diastolic, outlets.mean()});
  json["tolerance"] = outlets.tolerance;
  for (const auto& [face, share] : outlets.fractions) json["target_fractions"][face] = share;
  if (report.probe) json["probe"] = json_of(*report.probe, outlets);
  json["cycles"] = ordered_json::array();
  for (const auto& cycle : report.cycles) json["cycles"].push_back(json_of(cycle, outlets));
  if (!report.cycles.empty()) json["outlets_of_the_last_cycle"] = outlets_json(report.cycles.back(), outlets);
  json["seconds"] = report.seconds;
  files::write_atomically(report.folder / tuning_report_file, config::json_text(json));
}

void write_table(const TuningReport& report, const case_file::Case& c, double pressure) {
  const auto& outlets = *c.outlets;
  const std::string unit = c.output.units.pressure;
  std::string text = "cycle,total resistance [Pa s/m^3],total compliance [m^3/Pa],vessel compliance [m^3/Pa]";
  for (const char* what : {"measured", "0D first cycle", "0D periodic", "foreseen"})
    for (const char* value : {"systolic", "diastolic", "mean"}) text += fmt::format(",{} {} [{}]", what, value, unit);
  for (const auto& [face, share] : outlets.fractions) text += "," + face + " fraction";
  text += ",relative miss\n";
  int number = 0;
  for (const auto& cycle : report.cycles) {
    text += fmt::format("{},{:.8g},{:.8g},{:.8g}", ++number, cycle.totals.resistance, cycle.totals.compliance,
                        cycle.vessel.compliance);
    for (const auto& p : {cycle.measured(), cycle.foreseen_first(), zerod::pressures(cycle.periodic), cycle.foreseen()})
      text += fmt::format(",{:.6g},{:.6g},{:.6g}", p.systolic / pressure, p.diastolic / pressure, p.mean / pressure);
    for (const double share : cycle.fractions) text += fmt::format(",{:.6g}", share);
    text += fmt::format(",{:.6g}\n", cycle.miss(outlets));
  }
  files::write_atomically(report.folder / "tuning.csv", text);
}

void plot_cycles(const TuningReport& report, const case_file::Case& c, double pressure) {
  const auto& outlets = *c.outlets;
  std::vector<drawing::Series> series;
  const auto add = [&](const char* name, double zerod::Pressures::*value, double target, int colour) {
    drawing::Series reached{.name = name, .x = {}, .y = {}, .markers = true, .colour = colour},
        asked{.name = "", .x = {}, .y = {}, .dashed = true, .colour = colour};
    for (std::size_t k = 0; k < report.cycles.size(); ++k) {
      reached.x.push_back(static_cast<double>(k + 1));
      reached.y.push_back(report.cycles[k].foreseen().*value / pressure);
    }
    asked.x = {0.8, static_cast<double>(report.cycles.size()) + 0.2};
    asked.y = {target / pressure, target / pressure};
    series.push_back(reached), series.push_back(asked);
  };
  add("systolic", &zerod::Pressures::systolic, outlets.systolic, 0);
  add("mean", &zerod::Pressures::mean, outlets.mean(), 1);
  add("diastolic", &zerod::Pressures::diastolic, outlets.diastolic, 2);
  drawing::write_plot((report.folder / "tuning.svg").string(), series,
                      {.title = "Pressure at the inlet, and what was asked (dashed)",
                       .x_label = "cycle in 3D",
                       .y_label = fmt::format("pressure [{}]", c.output.units.pressure)});
}

void plot_pressure(const TuningReport& report, const case_file::Case& c, double pressure) {
  const TuningCycle& cycle = report.cycles.back();
  const double time = config::unit_factor(c.output.units.time, config::dimension::time);
  const auto scaled = [](std::vector<double> values, double unit) {
    for (double& v : values) v /= unit;
    return values;
  };
  const double end = cycle.first.times.back() / time;
  std::vector<drawing::Series> series{
      {.name = "3D", .x = scaled(cycle.run.times, time), .y = scaled(cycle.run.inlet_pressure, pressure)},
      {.name = "0D, same start",
       .x = scaled(cycle.first.times, time),
       .y = scaled(cycle.first.pressure, pressure),
       .dashed = true},
      {.name = "0D, periodic",
       .x = scaled(cycle.periodic.times, time),
       .y = scaled(cycle.periodic.pressure, pressure)}};
  for (const double target : {c.outlets->systolic, c.outlets->diastolic})
    series.push_back(
        {.name = "", .x = {0, end}, .y = {target / pressure, target / pressure}, .dashed = true, .colour = 6});
  drawing::write_plot((report.folder / "pressure.svg").string(), series,
                      {.title = fmt::format("Pressure at the inlet in cycle {}", report.cycles.size()),
                       .x_label = fmt::format("time [{}]", c.output.units.time),
                       .y_label = fmt::format("pressure [{}]", c.output.units.pressure)});
}

}  // namespace

zerod::Pressures TuningCycle::foreseen() const {
  const zerod::Pressures m = measured(), f = foreseen_first(), p = zerod::pressures(periodic);
  return {m.systolic + p.systolic - f.systolic, m.diastolic + p.diastolic - f.diastolic, m.mean + p.mean - f.mean};
}

double TuningCycle::miss(const case_file::TuningCase& outlets) const {
  const zerod::Pressures p = foreseen();
  return std::max({std::abs(p.systolic / outlets.systolic - 1), std::abs(p.diastolic / outlets.diastolic - 1),
                   std::abs(p.mean / zerod::pressures(periodic).mean - 1)});
}

void write_report(const TuningReport& report, const case_file::Case& c) {
  write_json(report, *c.outlets);
  if (report.cycles.empty()) return;
  const double pressure = config::unit_factor(c.output.units.pressure, config::dimension::pressure);
  write_table(report, c, pressure);
  plot_cycles(report, c, pressure);
  plot_pressure(report, c, pressure);
}

std::optional<EarlierTuning> find_tuning(const fs::path& folder) {
  files::refuse_other_than_file(folder / tuning_report_file);
  std::ifstream in(folder / tuning_report_file);
  if (!in) return std::nullopt;
  try {
    return EarlierTuning{artifacts::inputs_from_json(nlohmann::ordered_json::parse(in).at("inputs"))};
  } catch (const nlohmann::json::exception&) {
    return EarlierTuning{};
  }
}

}  // namespace tunica::stages
