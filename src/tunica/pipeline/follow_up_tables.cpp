// Tables and numbers of a follow-up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/units.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/follow_up_findings.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using unit::degree, unit::ml, unit::mm, unit::mm2;

double mmhg() { return config::unit_factor("mmHg", config::dimension::pressure); }

/// Columns of one length with their headers.
class Table {
 public:
  void add(const std::string& header, std::vector<double> values) {
    headers_.push_back(header);
    columns_.push_back(std::move(values));
  }
  std::string csv() const {
    std::string text;
    for (std::size_t c = 0; c < headers_.size(); ++c) text += (c > 0 ? "," : "") + headers_[c];
    text += "\n";
    for (std::size_t r = 0; r < columns_[0].size(); ++r)
      for (std::size_t c = 0; c < columns_.size(); ++c)
        text += fmt::format("{:.7g}{}", columns_[c][r], c + 1 < columns_.size() ? "," : "\n");
    return text;
  }

 private:
  std::vector<std::string> headers_;
  std::vector<std::vector<double>> columns_;
};

std::vector<double> in_unit(std::vector<double> values, double unit) {
  for (double& v : values) v /= unit;
  return values;
}

template <class Value>
std::vector<double> of_sections(const std::vector<analysis::AortaSection>& sections, const Value& value) {
  std::vector<double> values;
  for (const auto& section : sections) values.push_back(value(section));
  return values;
}

std::string stations_csv(const FollowUpFindings& f) {
  Table table;
  table.add("distance [mm]", in_unit(f.growth.stations, mm));
  for (std::size_t k = 0; k < f.scans.size(); ++k) {
    const std::string& name = f.plan.scans[k].name;
    const auto add = [&](const char* what, const auto& value) {
      table.add(fmt::format("{} {}", name, what), of_sections(f.growth.sections[k], value));
    };
    using Section = analysis::AortaSection;
    add("distance in the scan [mm]", [](const Section& s) { return s.s / mm; });
    const char* axes[] = {"x [mm]", "y [mm]", "z [mm]"};
    for (int i = 0; i < 3; ++i)
      add(axes[i], [&](const Section& s) { return f.scans[k]->anatomy.line.frame(s.s).origin[i] / mm; });
    add("diameter [mm]", [](const Section& s) { return s.diameter / mm; });
    add("largest diameter [mm]", [](const Section& s) { return s.largest_diameter / mm; });
    add("true lumen area [mm^2]", [](const Section& s) { return s.lumen_area[0] / mm2; });
    add("false lumen area [mm^2]", [](const Section& s) { return s.lumen_area[1] / mm2; });
    add("true lumen share", [](const Section& s) { return s.true_share(); });
    add("flap position [mm]", [](const Section& s) { return s.flap_position / mm; });
    add("wall thickness [mm]", [](const Section& s) { return s.wall_thickness / mm; });
    add("least wall thickness [mm]", [](const Section& s) { return s.least_wall_thickness / mm; });
    if (!f.loads[k]) continue;
    table.add(name + " wall stress [kPa]", in_unit(f.loads[k]->stress, 1e3));
    table.add(name + " TAWSS [Pa]", f.loads[k]->tawss);
    table.add(name + " true less false lumen pressure [mmHg]", in_unit(f.loads[k]->pressure_difference, mmhg()));
  }
  return table.csv();
}

std::string growth_csv(const FollowUpFindings& f) {
  Table table;
  table.add("distance [mm]", in_unit(f.growth.stations, mm));
  for (const auto& i : f.intervals) {
    table.add(i.name + " diameter [mm]", in_unit(i.diameter, mm));
    table.add(i.name + " diameter [mm/year]", in_unit(i.diameter, mm * i.years));
    for (std::size_t lumen = 0; lumen < 2; ++lumen)
      table.add(fmt::format("{} {} lumen area [mm^2/year]", i.name, analysis::lumen_names[lumen]),
                in_unit(i.area[lumen], mm2 * i.years));
  }
  return table.csv();
}

std::string segments_csv(const FollowUpFindings& f) {
  std::string text = "from,to,scan,date,length [mm],true lumen [ml],false lumen [ml]\n";
  for (const auto& s : f.growth.segments)
    for (std::size_t k = 0; k < f.scans.size(); ++k)
      text += fmt::format("{},{},{},{},{:.7g},{:.7g},{:.7g}\n", s.from, s.to, f.plan.scans[k].name,
                          f.plan.scans[k].date, s.length[k] / mm, s.volume[k][0] / ml, s.volume[k][1] / ml);
  return text;
}

std::string tears_csv(const FollowUpFindings& f) {
  std::string text = "tear,distance [mm]";
  for (const auto& scan : f.plan.scans) text += fmt::format(",{} area [mm^2]", scan.name);
  text += "\n";
  for (std::size_t t = 0; t < f.growth.tears.size(); ++t) {
    text += fmt::format("{},{:.7g}", t + 1, f.growth.tears[t].s / mm);
    for (const double area : f.growth.tears[t].area) text += fmt::format(",{:.7g}", area / mm2);
    text += "\n";
  }
  return text;
}

std::string branches_csv(const FollowUpFindings& f) {
  std::string text = "scan,branch,distance [mm],angle [deg]\n";
  for (std::size_t k = 0; k < f.scans.size(); ++k)
    for (const auto& l : f.scans[k]->anatomy.landmarks)
      text += fmt::format("{},{},{:.7g},{:.7g}\n", f.plan.scans[k].name, l.name, l.s / mm, l.angle / degree);
  return text;
}

std::string correlations_csv(const FollowUpFindings& f) {
  std::string text = "interval,growth,load,rank correlation,2.5 %,97.5 %,stations\n";
  for (const auto& c : f.correlations)
    text += fmt::format("{},{},{},{:.5g},{:.5g},{:.5g},{}\n", c.interval, c.growth, c.load, c.rank.value, c.rank.low,
                        c.rank.high, c.rank.pairs);
  return text;
}

// --- follow_up.json -------------------------------------------------------------------------------------------------

ordered_json interval_json(const FollowUpFindings& f, const Interval& i) {
  const auto most = std::max_element(i.diameter.begin(), i.diameter.end());
  const auto place = static_cast<std::size_t>(most - i.diameter.begin());
  return {{"name", i.name},
          {"years", i.years},
          {"largest_growth_of_diameter",
           {{"mm", *most / mm}, {"mm_per_year", *most / mm / i.years}, {"distance_mm", f.growth.stations[place] / mm}}},
          {"map",
           {{"elements", i.folds.elements},
            {"folded", i.folds.folded},
            {"least_jacobian", finite_or_null(i.folds.least_jacobian)}}}};
}

ordered_json segment_json(const FollowUpFindings& f, const analysis::GrowthSegment& s) {
  ordered_json page = {{"from", s.from}, {"to", s.to}};
  for (std::size_t k = 0; k < f.scans.size(); ++k)
    page["scans"].push_back({{"scan", f.plan.scans[k].name},
                             {"length_mm", s.length[k] / mm},
                             {"true_lumen_ml", s.volume[k][0] / ml},
                             {"false_lumen_ml", s.volume[k][1] / ml}});
  return page;
}

ordered_json json_of(const FollowUpFindings& f) {
  ordered_json page = {{"title", f.plan.settings.title}, {"file", f.plan.file.filename().string()}};
  for (const auto& scan : f.plan.scans)
    page["scans"].push_back({{"name", scan.name}, {"date", scan.date}, {"years", scan.years}});
  for (const auto& i : f.intervals) page["intervals"].push_back(interval_json(f, i));
  for (const auto& s : f.growth.segments) page["segments"].push_back(segment_json(f, s));
  page["tears"] = ordered_json::array();
  for (const auto& tear : f.growth.tears) {
    ordered_json areas = ordered_json::array();
    for (const double area : tear.area) areas.push_back(finite_or_null(area / mm2));
    page["tears"].push_back({{"distance_mm", tear.s / mm}, {"area_mm2", areas}});
  }
  page["correlations"] = ordered_json::array();
  for (const auto& c : f.correlations)
    page["correlations"].push_back({{"interval", c.interval},
                                    {"growth", c.growth},
                                    {"load", c.load},
                                    {"rank_correlation", finite_or_null(c.rank.value)},
                                    {"interval_95", {finite_or_null(c.rank.low), finite_or_null(c.rank.high)}},
                                    {"stations", c.rank.pairs}});
  return page;
}

std::vector<std::string> lines_of(const FollowUpFindings& f) {
  std::vector<std::string> lines;
  for (const auto& i : f.intervals) {
    const auto most = std::max_element(i.diameter.begin(), i.diameter.end());
    const double place = f.growth.stations[static_cast<std::size_t>(most - i.diameter.begin())];
    lines.push_back(fmt::format("{}: {:.2f} years, diameter up to {:+.1f} mm ({:+.1f} mm/year) at {:.0f} mm", i.name,
                                i.years, *most / mm, *most / mm / i.years, place / mm));
    if (i.folds.folded > 0)
      lines.push_back(fmt::format("warning: the map from {} turns {} of {} elements inside out; see docs/follow_up.md",
                                  i.name, i.folds.folded, i.folds.elements));
  }
  lines.push_back(fmt::format("follow-up: {}", (f.plan.output / "follow_up.html").string()));
  return lines;
}

}  // namespace

std::vector<fs::path> follow_up_files(const FollowUpPlan& plan) {
  std::vector<fs::path> files = {"follow_up.html", "follow_up.json", "stations.csv",     "growth.csv", "segments.csv",
                                 "tears.csv",      "branches.csv",   "correlations.csv", "growth.vtp"};
  for (std::size_t k = 0; k + 1 < plan.scans.size(); ++k)
    files.push_back(fmt::format("map_{}_to_{}.vtp", plan.scans[k].name, plan.scans[k + 1].name));
  return files;
}

std::vector<std::string> write_follow_up(const FollowUpFindings& f) {
  const auto& folder = f.plan.output;
  files::write_atomically(folder / "stations.csv", stations_csv(f));
  files::write_atomically(folder / "growth.csv", growth_csv(f));
  files::write_atomically(folder / "segments.csv", segments_csv(f));
  files::write_atomically(folder / "tears.csv", tears_csv(f));
  files::write_atomically(folder / "branches.csv", branches_csv(f));
  files::write_atomically(folder / "correlations.csv", correlations_csv(f));
  write_growth_maps(f);
  files::write_atomically(folder / "follow_up.json", config::json_text(json_of(f)));
  files::write_atomically(folder / "follow_up.html", follow_up_page(f));
  return lines_of(f);
}

}  // namespace tunica::pipeline
