#include "tunica/stages/post/report_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/digits.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::stages::post {

namespace {

using mesh::RegionKind;
using nlohmann::ordered_json;

/// "von Mises stress" -> "von_mises_stress".
std::string key_of(std::string name) {
  for (char& c : name) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

std::string percentile_key(double p) { return fmt::format("p{:g}", p); }

ordered_json pressures(const analysis::Course& c) {
  return {{"systolic_mmHg", c.largest / unit::mmHg},
          {"diastolic_mmHg", c.smallest / unit::mmHg},
          {"mean_mmHg", c.mean / unit::mmHg}};
}

ordered_json vector_mm(const Vec3<double>& x) {
  return ordered_json::array({x[0] / unit::mm, x[1] / unit::mm, x[2] / unit::mm});
}

/// Tells of a figure in which parts of the lumen it lies that the scheme disturbs, as Findings::too_dissipative().
void mark(ordered_json& figure, const Findings& f, const std::vector<std::string>& parts = {}) {
  if (const auto names = f.too_dissipative(parts); !names.empty()) figure["numerically_dissipated_in"] = names;
}

std::string part_of_lumen(std::size_t lumen) { return fmt::format("{} lumen", analysis::lumen_names[lumen]); }

ordered_json openings(const Findings& f) {
  ordered_json list = ordered_json::array();
  double outflow = 0;
  const auto& inlet = f.data.faces[f.vessel.inlet].name;
  for (const auto& o : f.openings)
    if (o.name != inlet) outflow += analysis::course(o.times, o.flow).mean;
  for (std::size_t k = 0; k < f.openings.size(); ++k) {
    const auto& o = f.openings[k];
    const auto flow = analysis::course(o.times, o.flow);
    ordered_json entry = {{"name", o.name},
                          {"inlet", o.name == inlet},
                          {"pressure", pressures(analysis::course(o.times, o.pressure))},
                          {"flow_outwards",
                           {{"mean_ml_s", flow.mean / unit::ml},
                            {"largest_ml_s", flow.largest / unit::ml},
                            {"smallest_ml_s", flow.smallest / unit::ml}}}};
    if (o.name != inlet) entry["share_of_outflow"] = flow.mean / outflow;
    if (!f.vessel.side.empty()) entry["lumen"] = analysis::lumen_names[f.vessel.openings[k].in_false_lumen ? 1 : 0];
    mark(entry, f, {part_of_lumen(f.vessel.openings[k].in_false_lumen ? 1 : 0)});
    list.push_back(std::move(entry));
  }
  return list;
}

/// Mean and percentiles by the area of the wall, which the nodes share.
ordered_json wall_shear(const Findings& f) {
  std::vector<double> area(f.data.points.size(), 0.0);
  for (const auto& t : f.vessel.inside)
    for (const auto node : t) area[static_cast<std::size_t>(node)] += norm(mesh::area_vector(f.data.points, t)) / 3;
  std::vector<std::pair<double, double>> tawss, osi, rrt;
  double sum = 0, total = 0, osi_sum = 0;
  for (std::size_t n = 0; n < area.size(); ++n) {
    if (area[n] == 0) continue;
    const double* s = f.fields.shear.data() + 4 * n;
    const auto figures = analysis::shear_figures(s[0], {{s[1], s[2], s[3]}}, f.window.until - f.window.from);
    tawss.emplace_back(figures.tawss, area[n]);
    osi.emplace_back(figures.osi, area[n]);
    rrt.emplace_back(figures.rrt, area[n]);
    sum += area[n] * figures.tawss;
    osi_sum += area[n] * figures.osi;
    total += area[n];
  }
  const std::vector<double> percents = {5, 50, 95, 99};
  const auto shares = [&](const std::vector<std::pair<double, double>>& values) {
    const auto found = analysis::percentiles(values, percents);
    ordered_json entry;
    for (std::size_t p = 0; p < percents.size(); ++p) entry[percentile_key(percents[p])] = found[p];
    return entry;
  };
  ordered_json report = {
      {"area_mm2", total / unit::mm2}, {"tawss_Pa", shares(tawss)}, {"osi", shares(osi)}, {"rrt_1_Pa", shares(rrt)}};
  report["tawss_Pa"]["mean"] = sum / total;
  report["osi"]["mean"] = osi_sum / total;
  mark(report, f);
  return report;
}

ordered_json stresses(const Findings& f) {
  ordered_json list = ordered_json::array();
  const auto peak = f.peak();
  for (const auto& part : f.frames.wall_parts()) {
    ordered_json entry = {{"name", part.name}, {"volume_mm3", f.frames.volume_of(part) * 1e9}};
    for (std::size_t q = 0; q < f.frames.stresses().size(); ++q) {
      const auto& quantity = f.frames.stresses()[q];
      const auto at_peak = f.figures.column(analysis::column::stress(part.name, quantity, "mean"))[peak];
      if (std::isnan(at_peak)) continue;  // there are no such fibres
      const auto most = analysis::percentiles(f.frames.values_in(part, f.fields.max_stress[q]), f.settings.percentiles);
      ordered_json of_peak = {{"mean", at_peak / unit::kPa}}, of_cycle;
      for (std::size_t p = 0; p < most.size(); ++p) {
        const double percent = f.settings.percentiles[p];
        const auto course =
            f.figures.column(analysis::column::stress(part.name, quantity, fmt::format("{:g}", percent)));
        of_peak[percentile_key(percent)] = course[peak] / unit::kPa;
        of_cycle[percentile_key(percent)] = most[p] / unit::kPa;
      }
      entry[key_of(quantity) + "_kPa"] = {{"at_peak", of_peak}, {"cycle_maximum", of_cycle}};
    }
    mark(entry, f);
    list.push_back(std::move(entry));
  }
  return list;
}

/// The lumens of a station, and the tears that it lies beside.
std::vector<std::string> parts_at(const Findings& f, const analysis::Station& station) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < 2; ++k)
    if (!station.sections[k].empty()) parts.push_back(part_of_lumen(k));
  for (std::size_t k = 0; f.lumens && k < f.lumens->tears.size(); ++k) {
    const auto& tear = f.lumens->tears[k];
    if (std::abs(tear.distance - station.distance) <= 2 * std::sqrt(tear.place.area / M_PI))
      parts.push_back(tear.place.name);
  }
  return parts;
}

ordered_json station_entries(const Findings& f) {
  ordered_json list = ordered_json::array();
  for (std::size_t s = 0; s < f.vessel.stations.size(); ++s) {
    const auto& station = f.vessel.stations[s];
    ordered_json entry = {{"distance_mm", station.distance / unit::mm}, {"centre_mm", vector_mm(station.centre)}};
    std::array<std::vector<double>, 2> pressure;
    for (std::size_t k = 0; k < 2; ++k) {
      if (station.sections[k].empty()) continue;
      pressure[k] = f.figures.column(analysis::column::station(s, k, "pressure"));
      const auto area = analysis::course(f.times, f.figures.column(analysis::column::station(s, k, "area"))),
                 flow = analysis::course(f.times, f.figures.column(analysis::column::station(s, k, "flow")));
      entry[std::string(analysis::lumen_names[k]) + "_lumen"] = {
          {"pressure", pressures(analysis::course(f.times, pressure[k]))},
          {"area",
           {{"mean_mm2", area.mean / unit::mm2},
            {"largest_mm2", area.largest / unit::mm2},
            {"smallest_mm2", area.smallest / unit::mm2}}},
          {"flow_downstream_mean_ml_s", flow.mean / unit::ml}};
    }
    if (!pressure[0].empty() && !pressure[1].empty()) {
      for (std::size_t k = 0; k < pressure[0].size(); ++k) pressure[0][k] -= pressure[1][k];
      const auto difference = analysis::course(f.times, pressure[0]);
      entry["true_minus_false_pressure"] = {{"mean_mmHg", difference.mean / unit::mmHg},
                                            {"largest_mmHg", difference.largest / unit::mmHg},
                                            {"smallest_mmHg", difference.smallest / unit::mmHg}};
    }
    mark(entry, f, parts_at(f, station));
    list.push_back(std::move(entry));
  }
  return list;
}

ordered_json tears(const Findings& f) {
  ordered_json list = ordered_json::array();
  const auto& lumens = *f.lumens;
  for (std::size_t k = 0; k < lumens.tears.size(); ++k) {
    const auto& tear = lumens.tears[k];
    const auto flow = analysis::course(lumens.times, tear.flow);
    list.push_back({{"name", tear.place.name},
                    {"entry", k == lumens.entry()},
                    {"centre_mm", vector_mm(tear.place.centre)},
                    {"distance_mm", tear.distance / unit::mm},
                    {"area_mm2", tear.place.area / unit::mm2},
                    {"volume_into_false_lumen_ml", flow.forward / unit::ml},
                    {"volume_out_of_false_lumen_ml", flow.backward / unit::ml},
                    {"flow_into_false_lumen",
                     {{"mean_ml_s", flow.mean / unit::ml},
                      {"largest_ml_s", flow.largest / unit::ml},
                      {"smallest_ml_s", flow.smallest / unit::ml}}}});
    mark(list.back(), f, {tear.place.name});
  }
  return list;
}

/// Its balance and its ejection fraction are those of its tears, too.
std::vector<std::string> parts_of_false_lumen(const LumenFlows& lumens) {
  std::vector<std::string> parts{part_of_lumen(1)};
  for (const auto& tear : lumens.tears) parts.push_back(tear.place.name);
  return parts;
}

/// Flows below this share of the largest through an opening are zero to the accuracy of the solver: a lumen that only
/// such flows enter has no ejection fraction, and no balance to set against them.
constexpr double still_share = 1e-6;

double largest_opening_flow(const Findings& f) {
  double largest = 0;
  for (const auto& opening : f.openings)
    for (const double flow : opening.flow) largest = std::max(largest, std::abs(flow));
  return largest;
}

/// Null where the denominator is as good as zero.
ordered_json ratio(double numerator, double denominator, double zero) {
  return denominator > zero ? ordered_json(numerator / denominator) : ordered_json(nullptr);
}

/// `still`: flow that counts as none [m^3/s].
ordered_json mass_balance(const LumenFlows& lumens, double still) {
  double largest_flow = 0, largest_rest = 0, squares = 0, largest_leakage = 0;
  for (const double leakage : lumens.leakage) largest_leakage = std::max(largest_leakage, std::abs(leakage));
  const auto weights = analysis::trapezoid_weights(lumens.times);
  const auto rest = lumens.residual();
  for (std::size_t k = 0; k < rest.size(); ++k) {
    largest_rest = std::max(largest_rest, std::abs(rest[k]));
    squares += weights[k] * rest[k] * rest[k];
    for (const auto& tear : lumens.tears) largest_flow = std::max(largest_flow, std::abs(tear.flow[k]));
  }
  return {{"largest_flow_through_a_tear_ml_s", largest_flow / unit::ml},
          {"largest_wall_leakage_ml_s", largest_leakage / unit::ml},
          {"largest_residual_ml_s", largest_rest / unit::ml},
          {"rms_residual_ml_s", std::sqrt(squares / (lumens.times.back() - lumens.times.front())) / unit::ml},
          {"largest_residual_of_largest_flow", ratio(largest_rest, largest_flow, still)}};
}

ordered_json course_ml(const analysis::Course& c) {
  return {{"mean_ml", c.mean / unit::ml}, {"largest_ml", c.largest / unit::ml}, {"smallest_ml", c.smallest / unit::ml}};
}

ordered_json false_lumen(const Findings& f) {
  const auto& lumens = *f.lumens;
  const auto rate = analysis::course(lumens.times, lumens.volume_rate);
  ordered_json report = {{"flows_from", lumens.source == LumenFlows::Source::run ? "run" : "cuts"},
                         {"volume", course_ml(analysis::course(lumens.times, lumens.volume))},
                         {"dV_dt",
                          {{"mean_ml_s", rate.mean / unit::ml},
                           {"largest_ml_s", rate.largest / unit::ml},
                           {"smallest_ml_s", rate.smallest / unit::ml}}},
                         {"openings", ordered_json::array()}};
  for (const auto& o : f.vessel.openings)
    if (o.in_false_lumen) report["openings"].push_back(o.name);
  mark(report, f, parts_of_false_lumen(lumens));
  if (lumens.tears.empty()) return report;
  const auto& entry = lumens.tears[lumens.entry()];
  const auto flow = analysis::course(lumens.times, entry.flow);
  report["entry_tear"] = entry.place.name;
  const double still = still_share * largest_opening_flow(f);
  report["ejection_fraction"] =
      ratio(flow.backward, flow.forward, still * (lumens.times.back() - lumens.times.front()));
  report["mass_balance"] = mass_balance(lumens, still);
  return report;
}

ordered_json flap(const Findings& f) {
  const auto mean = analysis::course(f.times, f.figures.column(analysis::column::flap_mean)),
             largest = analysis::course(f.times, f.figures.column(analysis::column::flap_largest));
  ordered_json report = {{"region", f.settings.flap},
                         {"relative_to_s", base::without_noise(f.times.front())},
                         {"largest_displacement_mm", largest.largest / unit::mm},
                         {"time_of_largest_s", base::without_noise(largest.time_of_largest)},
                         {"largest_mean_displacement_mm", mean.largest / unit::mm},
                         {"mean_displacement_over_the_cycle_mm", mean.mean / unit::mm}};
  mark(report, f);
  return report;
}

}  // namespace

ordered_json report_json(const Findings& f) {
  ordered_json report = {{"program", {{"version", f.program.version}, {"commit", f.program.commit}}},
                         {"title", f.title},
                         {"case", f.case_file.string()},
                         {"results", f.results.string()},
                         {"window",
                          {{"from_s", base::without_noise(f.window.from)},
                           {"until_s", base::without_noise(f.window.until)},
                           {"fields", f.times.size()}}},
                         {"peak_s", base::without_noise(f.times[f.peak()])},
                         {"left_out", ordered_json::array()},
                         {"warnings", f.warnings}};
  for (const auto& part : f.left_out) report["left_out"].push_back({{"part", part.part}, {"why", part.why}});
  if (f.dissipation) report["numerical_dissipation"] = to_json(*f.dissipation);
  if (!f.openings.empty()) report["openings"] = openings(f);
  if (!f.vessel.inside.empty()) report["wall_shear"] = wall_shear(f);
  if (!f.frames.stresses().empty()) report["stress"] = stresses(f);
  if (f.has_stations()) report["stations"] = station_entries(f);
  if (f.lumens && !f.lumens->tears.empty()) report["tears"] = tears(f);
  if (f.lumens) report["false_lumen"] = false_lumen(f);
  if (f.has_flap()) report["flap"] = flap(f);
  return report;
}

}  // namespace tunica::stages::post
