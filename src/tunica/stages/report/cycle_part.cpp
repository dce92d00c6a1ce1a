// Figures of a cycle, as docs/post.md lays them out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tunica/artifacts/dissipation.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/stages/report/parts.hpp"
#include "tunica/viewer/view_page.hpp"

namespace tunica::stages::report {

namespace {

using Columns = std::vector<std::pair<std::string, std::string>>;  ///< heading, path

/// `path`: of the list in post.json; entries without `needed` are left out.
std::string list_table(const Results& r, const std::string& path, const Columns& columns,
                       const std::string& needed = "") {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  for (const auto& [heading, below] : columns) head.push_back(heading);
  const json list = at(r.post, path);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!needed.empty() && !at(list[k], needed).is_object()) continue;
    auto& cells = rows.emplace_back();
    const std::string name = list[k].value("name", std::to_string(k + 1));
    for (const auto& [heading, below] : columns) {
      const json value = at(list[k], below);
      cells.push_back(figure(value) +
                      (value.is_number() ? band(r, fmt::format("{}/{}/{}", path, name, below)) + mark(list[k]) : ""));
    }
  }
  return drawing::page::table(head, rows);
}

/// Flow the way that blood goes, as in the curves: in at the inlet, out elsewhere.
std::string openings(const Results& r) {
  const json list = at(r.post, "openings");
  if (!list.is_array()) return "";
  double most = 0;
  for (const auto& o : list)
    for (const char* which : {"largest", "smallest"})
      if (const json q = at(o, fmt::format("flow_outwards/{}_ml_s", which)); q.is_number())
        most = std::max(most, std::abs(q.get<double>()));
  std::vector<std::vector<std::string>> rows;
  for (const auto& o : list) {
    const std::string name = o.value("name", "");
    const bool inlet = o.value("inlet", false);
    auto& cells = rows.emplace_back();
    const auto add = [&](const std::string& path, double factor) {
      const json value = at(o, path);
      if (!value.is_number()) return cells.push_back("–");
      const double shown = factor * value.get<double>();
      const bool is_flow = path.starts_with("flow");
      cells.push_back(figure(is_flow && std::abs(shown) < 1e-9 * most ? 0.0 : shown) +
                      band(r, fmt::format("openings/{}/{}", name, path)) + mark(o));
    };
    cells.push_back(readable(name) + (inlet ? " (inlet)" : ""));
    cells.push_back(figure(at(o, "lumen")));
    for (const char* which : {"systolic", "diastolic", "mean"}) add(fmt::format("pressure/{}_mmHg", which), 1);
    const double sign = inlet ? -1 : 1;
    add("flow_outwards/mean_ml_s", sign);
    add(inlet ? "flow_outwards/smallest_ml_s" : "flow_outwards/largest_ml_s", sign);
    add(inlet ? "flow_outwards/largest_ml_s" : "flow_outwards/smallest_ml_s", sign);
    add("share_of_outflow", 100);
  }
  return "<h3>Openings</h3>\n" +
         drawing::page::table({"opening", "lumen", "systolic [mmHg]", "diastolic [mmHg]", "mean [mmHg]",
                               "mean flow [ml/s]", "largest", "smallest", "share of the outflow [%]"},
                              rows,
                              "Flow is positive into the vessel at the inlet and out of it at all other openings");
}

std::string tears(const Results& r) {
  const json& post = r.post;
  if (!post.contains("tears")) return "";
  const json from = at(post, "false_lumen/flows_from");
  std::string text = std::string("<h3>Tears and false lumen</h3>\n") +
                     (from == "run" ? ""
                                    : missing("By cuts through the fields",
                                              "flows and balance miss mass by several "
                                              "per cent, since the run has not written those that it conserves")) +
                     list_table(r, "tears",
                                {{"tear", "name"},
                                 {"entry", "entry"},
                                 {"from the inlet [mm]", "distance_mm"},
                                 {"area [mm²]", "area_mm2"},
                                 {"into the false lumen [ml]", "volume_into_false_lumen_ml"},
                                 {"out of it [ml]", "volume_out_of_false_lumen_ml"},
                                 {"mean flow into it [ml/s]", "flow_into_false_lumen/mean_ml_s"},
                                 {"largest", "flow_into_false_lumen/largest_ml_s"},
                                 {"smallest", "flow_into_false_lumen/smallest_ml_s"}});
  const json lumen = at(post, "false_lumen");
  const auto value = [&](const char* path) {
    return figure(at(lumen, path)) + band(r, fmt::format("false_lumen/{}", path)) + mark(lumen);
  };
  return text + drawing::page::table({"false lumen", ""}, {{"ejection fraction (0 to 1)", value("ejection_fraction")},
                                                           {"mean volume [ml]", value("volume/mean_ml")},
                                                           {"largest volume [ml]", value("volume/largest_ml")},
                                                           {"smallest volume [ml]", value("volume/smallest_ml")},
                                                           {"largest residual of its mass balance [ml/s]",
                                                            value("mass_balance/largest_residual_ml_s")},
                                                           {"the same, of the largest flow through a tear",
                                                            value("mass_balance/largest_residual_of_largest_flow")}});
}

std::string flap(const Results& r) {
  const json& post = r.post;
  const json f = at(post, "flap");
  if (f.is_null()) return "";
  const auto value = [&](const char* key) {
    return figure(at(f, key)) + band(r, fmt::format("flap/{}", key)) + mark(f);
  };
  return "<h3>Flap</h3>\n" +
         drawing::page::table({"displacement since the start of the window", ""},
                              {{"largest [mm]", value("largest_displacement_mm")},
                               {"at [s]", value("time_of_largest_s")},
                               {"largest mean over the flap [mm]", value("largest_mean_displacement_mm")},
                               {"mean over flap and cycle [mm]", value("mean_displacement_over_the_cycle_mm")}});
}

std::string wall_shear(const Results& r) {
  const json& post = r.post;
  const json shear = at(post, "wall_shear");
  if (shear.is_null()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, key] : {std::pair{"TAWSS [Pa]", "tawss_Pa"}, {"OSI", "osi"}, {"RRT [1/Pa]", "rrt_1_Pa"}}) {
    auto& cells = rows.emplace_back(std::vector<std::string>{name});
    for (const char* share : {"mean", "p5", "p50", "p95", "p99"})
      if (const json value = at(shear, fmt::format("{}/{}", key, share)); value.is_number())
        cells.push_back(figure(value) + band(r, fmt::format("wall_shear/{}/{}", key, share)) + mark(shear));
      else
        cells.push_back("–");
  }
  return "<h3>Wall shear</h3>\n" +
         drawing::page::table({"by area of the wall", "mean", "5 %", "median", "95 %", "99 %"}, rows);
}

/// "von_mises_stress_kPa" -> "von mises stress [kPa]".
std::string name_of(std::string key) {
  const std::string unit = "_kPa";
  if (key.ends_with(unit)) key = key.substr(0, key.size() - unit.size()) + " [kPa]";
  for (char& c : key) c = c == '_' ? ' ' : c;
  return key;
}

std::string stress(const Results& r) {
  const json& post = r.post;
  if (!post.contains("stress")) return "";
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  for (const auto& region : post["stress"])
    for (const auto& [key, values] : region.items()) {
      if (!values.is_object()) continue;
      head = {"region", "stress"};
      std::vector<std::string> cells = {readable(region.value("name", "")), drawing::page::escaped(name_of(key))};
      for (const auto& [when, label] :
           {std::pair{"at_peak", "at peak pressure"}, {"cycle_maximum", "largest of the cycle"}})
        for (const auto& [percent, value] : values[when].items()) {
          head.push_back(fmt::format("{}, {}", label, percent == "mean" ? "mean" : percent.substr(1) + " %"));
          cells.push_back(figure(value) +
                          band(r, fmt::format("stress/{}/{}/{}/{}", region.value("name", ""), key, when, percent)) +
                          mark(region));
        }
      rows.push_back(cells);
    }
  return "<h3>Stress in the wall, percentiles by volume</h3>\n" + drawing::page::table(head, rows);
}

std::string difference(const Results& r) {
  const json& post = r.post;
  if (!post.contains("stations") || post["stations"].empty()) return "";
  if (!post["stations"][0].contains("true_minus_false_pressure") &&
      !post["stations"].back().contains("true_minus_false_pressure") && !post.contains("false_lumen"))
    return "";
  return "<h3>True less false lumen</h3>\n<details><summary>Pressure difference along the aorta</summary>\n" +
         list_table(r, "stations",
                    {{"from the inlet [mm]", "distance_mm"},
                     {"mean [mmHg]", "true_minus_false_pressure/mean_mmHg"},
                     {"largest", "true_minus_false_pressure/largest_mmHg"},
                     {"smallest", "true_minus_false_pressure/smallest_mmHg"},
                     {"area of the true lumen [mm²]", "true_lumen/area/mean_mm2"},
                     {"of the false one", "false_lumen/area/mean_mm2"}},
                    "true_minus_false_pressure") +
         "</details>\n";
}

/// Plots whose title begins so.
std::string curves(const std::vector<viewer::Plot>& plots, const std::string& title) {
  std::string text;
  for (std::size_t k = 0; k < plots.size(); ++k)
    if (plots[k].title.starts_with(title)) text += viewer::plot(plots, k, drawing::page::escaped(plots[k].title));
  return text;
}

}  // namespace

std::string cycle_part(const Results& r, const std::vector<viewer::Plot>& plots) {
  std::string text = "<h2 id=\"cycle\">The beat</h2>\n";
  if (r.post.is_null())
    return text + missing("Figures of the cycle", "the case has no stage `post`, or it is not done");
  text += fmt::format("<p>From {} s to {} s, {} fields; highest pressure at {} s.</p>\n",
                      figure(at(r.post, "window/from_s")), figure(at(r.post, "window/until_s")),
                      figure(at(r.post, "window/fields")), figure(at(r.post, "peak_s")));
  for (const auto& left : at(r.post, "left_out")) text += missing(left.value("part", ""), left.value("why", ""));
  const json d = at(r.post, "numerical_dissipation");
  const auto of_scheme = d.is_null() ? std::nullopt : warning_of(artifacts::dissipation_from_json(d));
  for (const auto& warning : at(r.post, "warnings"))
    if (warning != of_scheme.value_or("")) text += missing("Warning", warning.get<std::string>());  // that one is below
  if (r.bands.is_object())
    text += "<p>± is the error band of <code>tunica converge</code>, from finer meshes and smaller steps.</p>\n";
  if (r.bands.is_boolean())
    text += missing("Error bands", "those of converge/ are of other figures than these; do `tunica converge` anew");
  if (!d.is_null()) text += dissipation_table(d);
  return text + openings(r) + curves(plots, "Pressure at the openings") + curves(plots, "Flow at the openings") +
         difference(r) + curves(plots, "Pressure of the true") + curves(plots, "Pressure along") +
         curves(plots, "Flow along") + curves(plots, "Area along") + tears(r) +
         curves(plots, "Flow through the tears") + flap(r) + curves(plots, "Displacement of the flap") + wall_shear(r) +
         stress(r) + curves(plots, "Von Mises");
}

}  // namespace tunica::stages::report
