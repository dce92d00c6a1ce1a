// Summary, and the stages before the run.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <regex>

#include "tunica/base/digits.hpp"
#include "tunica/base/units.hpp"
#include "tunica/config/description.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/stages/report/parts.hpp"

namespace tunica::stages::report {

namespace {

namespace fs = std::filesystem;

/// More than these are no tears that anybody has named, and stand in one line.
constexpr auto most_tears = 12;

std::string stage_table(const Results& r) {
  std::vector<std::vector<std::string>> rows;
  double total = 0;
  for (const char* stage : {"mesh", "fibres", "prestress", "outlets", "run", "post"}) {
    const auto found = r.records.find(stage);
    if (found == r.records.end()) continue;
    const json& record = found->second;
    total += record.value("seconds", 0.0);
    rows.push_back(
        {stage, figure(at(record, "status")), fmt::format("{:.1f}", record.value("seconds", 0.0)),
         figure(at(record, "ranks")), figure(at(record, "time")),
         drawing::page::escaped(record["program"].value("version", "") + " " + record["program"].value("commit", ""))});
  }
  if (rows.empty()) return missing("Stages", "none of the folders holds a stage.json");
  rows.push_back({"all", "", fmt::format("{:.1f}", total), "", "", ""});
  return drawing::page::table({"stage", "status", "seconds", "ranks", "finished (UTC)", "program"}, rows);
}

/// A number without the noise of its last digits; other text as it is.
std::string setting(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole ? fmt::format("{}", base::without_noise(number)) : text;
}

/// What went into the run, key by key, in SI units.
std::string settings_table(const Results& r) {
  const auto run = r.records.find("run");
  if (run == r.records.end()) return "";
  std::vector<std::vector<std::string>> rows;
  const json settings = at(at(run->second, "inputs"), "settings");
  for (const auto& [key, value] : settings.items())
    rows.push_back({drawing::page::escaped(key), drawing::page::escaped(setting(value.get<std::string>()))});
  return "<details class=\"fine\"><summary>All settings of the run, in SI units</summary>\n" +
         drawing::page::table({"key", "value"}, rows) + "</details>\n";
}

/// Elements across the parts of the lumen of the run.
std::string across_table(const json& parts) {
  if (!parts.is_array() || parts.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  std::size_t tears = 0;
  double least = std::numeric_limits<double>::infinity(), median = least;
  const auto is_tear = [](const json& part) { return part.value("name", "").starts_with("tear "); };
  const bool many = std::count_if(parts.begin(), parts.end(), is_tear) > most_tears;
  for (const auto& part : parts) {
    if (many && is_tear(part)) {
      ++tears;
      least = std::min(least, part.value("least", least));
      median = std::min(median, part.value("median", median));
      continue;
    }
    rows.push_back(
        {drawing::page::escaped(part.value("name", "")), figure(at(part, "least"), 3), figure(at(part, "median"), 3)});
  }
  if (many)
    rows.push_back(
        {fmt::format("the worst of {} places where the lumens touch", tears), figure(least, 3), figure(median, 3)});
  return "<p>Elements across the lumen; flow needs 4 quadratic or 10 linear ones.</p>\n" +
         drawing::page::table({"part", "least", "median"}, rows);
}

std::string histogram(const json& counts, double bin, const std::string& title, const std::string& label) {
  drawing::Series bars{"", {}, {}};
  double place = 0;
  for (const auto& n : counts) {
    for (const double x : {place, place + bin}) bars.x.push_back(x), bars.y.push_back(std::max(0.5, n.get<double>()));
    place += bin;
  }
  return drawing::page::drawing(drawing::draw_plot(
      {bars}, {.title = title, .x_label = label, .y_label = "elements", .log_y = true, .width = 420, .height = 320}));
}

}  // namespace

std::string summary_part(const Results& r, const artifacts::ProgramVersion& program) {
  std::string text = fmt::format("<p>tunica {} ({}).", drawing::page::escaped(program.version),
                                 drawing::page::escaped(program.commit));
  if (const json mesh = at(r.manifest, "mesh"); mesh.is_object()) {
    text += fmt::format(" {} nodes, {} elements", figure(at(mesh, "nodes")), figure(at(mesh, "elements")));
    for (const auto& region : at(mesh, "regions"))
      text += fmt::format(", {} {}", drawing::page::escaped(region.value("name", "")), figure(at(region, "elements")));
    text += ".";
  }
  text += "</p>\n" + across_table(at(at(r.manifest, "mesh"), "elements_across"));
  return text + "<h3 id=\"stages\">Stages</h3>\n" + stage_table(r) + settings_table(r);
}

std::string mesh_part(const Results& r) {
  std::string text = "<h2 id=\"mesh\">Geometry</h2>\n";
  if (r.mesh.is_null()) return text + missing("Quality of the mesh", "the case has no stage `mesh`, or it is not done");
  const fs::path page = r.folder("mesh") / "report.html";
  if (!fs::exists(page)) return text + missing("Quality of the mesh", "report.html is not in the folder of the mesh");
  static const std::regex level("<(/?)h2");  // of that page
  return text + "<details><summary>" +
         fmt::format("{} tetrahedra, smallest dihedral angle {}°; pictures, shapes, regions, tears",
                     figure(at(r.mesh, "tetrahedra")), figure(r.mesh["shapes"]["smallest_dihedral_deg"], 3)) +
         "</summary>\n" + std::regex_replace(drawing::page::body(config::read_text(page)), level, "<$1h3") +
         "</details>\n";
}

std::string fibres_part(const Results& r) {
  std::string text = "<h3 id=\"fibres\">Material directions</h3>\n";
  if (r.fibres.is_null()) return text + missing("Directions", "the case has no stage `fibres`, or it is not done");
  std::vector<std::vector<std::string>> rows;
  const auto line = [&](const json& region, const std::string& name) {
    rows.push_back({drawing::page::escaped(name), figure(at(region, "elements")),
                    figure(at(region, "jump_above_30_deg_percent"), 3), figure(at(region, "mean_confidence"), 3)});
  };
  for (const auto& region : at(r.fibres, "regions")) line(region, region.value("name", ""));
  line(at(r.fibres, "wall"), "all");
  return text +
         drawing::page::table({"region", "elements", "jump to a neighbour above 30° [%]", "mean confidence, 0 to 1"},
                              rows) +
         histogram(r.fibres["wall"]["confidence_histogram_0.1"], 0.1, "Confidence of the directions", "confidence");
}

std::string prestress_part(const Results& r) {
  std::string text = "<h3 id=\"prestress\">Prestress</h3>\n";
  if (r.prestress.is_null()) return text + missing("Prestress", "the case has no stage `prestress`, or it is not done");
  std::vector<std::vector<std::string>> rows = {
      {"converged", figure(at(r.prestress, "converged"))},
      {"iterations of the fixed point", figure(at(r.prestress, "iterations"))},
      {"largest displacement under the load [mm]",
       figure(1e3 * r.prestress.value("largest_displacement_m", std::nan("")), 3)}};
  if (const json flow = at(r.prestress, "steady_flow"); flow.is_object()) {
    rows.push_back({"steps to the steady flow", figure(at(flow, "steps"))});
    rows.push_back({"change of velocity in its last step [%]",
                    figure(100 * flow.value("change_of_velocity_in_the_last_step", std::nan("")), 3)});
    rows.push_back({"change of pressure in its last step [%]",
                    figure(100 * flow.value("change_of_pressure_in_the_last_step", std::nan("")), 3)});
  }
  if (r.prestress.contains("failure")) rows.push_back({"failure", figure(at(r.prestress, "failure"))});
  return text + drawing::page::table({"", ""}, rows) +
         drawings(r.folder("prestress"), {{"fixed_point.svg", "Displacement of the imaged wall under its load"}});
}

std::string outlets_part(const Results& r) {
  std::string text = "<h3 id=\"outlets\">Outlets</h3>\n";
  if (r.tuning.is_null()) return text + missing("Tuned outlets", "the case has no stage `outlets`, or it is not done");
  const json cycles = at(r.tuning, "cycles"), targets = at(r.tuning, "targets");
  text += fmt::format("<p>Status: {}; tolerance {} %.</p>\n", figure(at(r.tuning, "status")),
                      figure(100 * r.tuning.value("tolerance", std::nan("")), 3));
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> head = {"pressure at the inlet [mmHg]", "target"};
  for (std::size_t k = 0; k < cycles.size(); ++k) head.push_back(fmt::format("cycle {} in 3D", k + 1));
  for (const char* value : {"systolic", "diastolic", "mean"}) {
    const std::string key = fmt::format("{}_Pa", value);
    const std::string target = fmt::format("{:.1f}", targets.value(key, std::nan("")) / unit::mmHg);
    const bool mean = value == std::string_view("mean");  // follows from the other two and the inflow
    std::vector<std::string> cells = {value, mean ? fmt::format("none; by rule of thumb {}", target) : target};
    for (const auto& cycle : cycles)
      cells.push_back(fmt::format("{:.1f}", at(cycle, "measured").value(key, std::nan("")) / unit::mmHg));
    rows.push_back(cells);
  }
  text += drawing::page::table(head, rows);
  rows.clear();
  const json fractions = at(r.tuning, "target_fractions");
  for (const auto& [face, share] : fractions.items())
    rows.push_back({drawing::page::escaped(face), figure(100 * share.get<double>(), 3),
                    cycles.empty() ? "–" : figure(100 * cycles.back()["fractions"].value(face, std::nan("")), 3)});
  return text + drawing::page::table({"outlet", "target [% of the outflow]", "last cycle [%]"}, rows) +
         drawings(r.folder("outlets"), {{"tuning.svg", "Pressures cycle by cycle"},
                                        {"pressure.svg", "The last cycle in 3D and in the 0D model"}});
}

}  // namespace tunica::stages::report
