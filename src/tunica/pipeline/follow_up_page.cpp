// The page of a follow-up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/units.hpp"
#include "tunica/config/units.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/geometry/parametric_dissection.hpp"
#include "tunica/pipeline/follow_up_findings.hpp"

namespace tunica::pipeline {

namespace {

namespace page = drawing::page;
using unit::mm, unit::ml;

std::string with_decimals(double value, int digits = 1) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}
std::string change(double value, int digits = 1) {
  return std::isfinite(value) ? fmt::format("{:+.{}f}", value, digits) : "–";
}

std::string plot(const std::vector<drawing::Series>& series, const std::string& title, const std::string& y_label) {
  const bool some = std::any_of(series.begin(), series.end(), [](const auto& s) {
    return std::any_of(s.y.begin(), s.y.end(), [](double y) { return std::isfinite(y); });
  });
  if (!some) return "";
  return page::drawing(drawing::draw_plot(
      series, {.title = title, .x_label = "distance along the aorta of the first scan [mm]", .y_label = y_label}));
}

std::vector<double> distances(const FollowUpFindings& f) {
  std::vector<double> x;
  for (const double s : f.growth.stations) x.push_back(s / mm);
  return x;
}

template <class Value>
std::string plot_of_scans(const FollowUpFindings& f, const std::string& title, const std::string& y_label,
                          const Value& value) {
  std::vector<drawing::Series> series;
  for (std::size_t k = 0; k < f.scans.size(); ++k) {
    auto& s = series.emplace_back(drawing::Series{.name = f.plan.scans[k].name, .x = distances(f), .y = {}});
    for (const auto& section : f.growth.sections[k]) s.y.push_back(value(section));
  }
  return plot(series, title, y_label);
}

std::string shape_plots(const FollowUpFindings& f) {
  using Section = analysis::AortaSection;
  return plot_of_scans(f, "Diameter of both lumens together", "diameter [mm]",
                       [](const Section& s) { return s.diameter / mm; }) +
         plot_of_scans(f, "True lumen", "area [mm^2]", [](const Section& s) { return s.lumen_area[0] / (mm * mm); }) +
         plot_of_scans(f, "False lumen", "area [mm^2]", [](const Section& s) { return s.lumen_area[1] / (mm * mm); }) +
         plot_of_scans(f, "Position of the flap, towards the true lumen", "position [mm]",
                       [](const Section& s) { return s.flap_position / mm; }) +
         plot_of_scans(f, "Thickness of the wall", "thickness [mm]",
                       [](const Section& s) { return s.wall_thickness / mm; });
}

std::string growth_plot(const FollowUpFindings& f) {
  std::vector<drawing::Series> series;
  for (const auto& i : f.intervals) {
    auto& s = series.emplace_back(drawing::Series{.name = i.name, .x = distances(f), .y = {}});
    for (const double d : i.diameter) s.y.push_back(d / mm / i.years);
  }
  return plot(series, "Growth of the diameter", "growth [mm/year]");
}

std::string intervals_table(const FollowUpFindings& f) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& i : f.intervals) {
    const auto most = std::max_element(i.diameter.begin(), i.diameter.end());
    const auto at = static_cast<std::size_t>(most - i.diameter.begin());
    rows.push_back({page::escaped(i.name), with_decimals(i.years, 2), change(*most / mm), change(*most / mm / i.years),
                    with_decimals(f.growth.stations[at] / mm, 0), std::to_string(i.folds.elements),
                    std::to_string(i.folds.folded), with_decimals(i.folds.least_jacobian, 2)});
  }
  return page::table({"interval", "years", "largest growth of the diameter [mm]", "[mm/year]", "at [mm]",
                      "elements mapped", "of these folded", "least Jacobian"},
                     rows, "Growth from scan to scan, and the map between them");
}

std::string segments_table(const FollowUpFindings& f) {
  std::vector<std::string> head = {"from", "to"};
  for (const auto& scan : f.plan.scans)
    for (const char* what : {"length [mm]", "true lumen [ml]", "false lumen [ml]"})
      head.push_back(page::escaped(fmt::format("{}: {}", scan.name, what)));
  head.insert(head.end(), {"true lumen [ml/year]", "false lumen [ml/year]"});
  std::vector<std::vector<std::string>> rows;
  for (const auto& s : f.growth.segments) {
    auto& row = rows.emplace_back(std::vector<std::string>{page::escaped(s.from), page::escaped(s.to)});
    for (std::size_t k = 0; k < f.scans.size(); ++k)
      row.insert(row.end(), {with_decimals(s.length[k] / mm), with_decimals(s.volume[k][0] / ml),
                             with_decimals(s.volume[k][1] / ml)});
    for (std::size_t lumen = 0; lumen < 2; ++lumen)
      row.push_back(change((s.volume.back()[lumen] - s.volume.front()[lumen]) / ml / f.plan.scans.back().years));
  }
  return page::table(head, rows, "Volumes between branches; rates from the first scan to the last");
}

std::string tears_table(const FollowUpFindings& f) {
  if (f.growth.tears.empty()) return "";
  std::vector<std::string> head = {"tear", "at [mm]"};
  for (const auto& scan : f.plan.scans) head.push_back(page::escaped(scan.name + ": area [mm^2]"));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t t = 0; t < f.growth.tears.size(); ++t) {
    const auto& tear = f.growth.tears[t];
    auto& row = rows.emplace_back(std::vector<std::string>{std::to_string(t + 1), with_decimals(tear.s / mm, 0)});
    for (const double area : tear.area) row.push_back(with_decimals(area / (mm * mm), 0));
  }
  return page::table(head, rows, "Tears; – where a scan has none there");
}

std::string branches_table(const FollowUpFindings& f) {
  std::vector<std::string> head = {"branch"};
  for (const auto& scan : f.plan.scans) head.push_back(page::escaped(scan.name + ": distance [mm]"));
  std::vector<std::vector<std::string>> rows;
  for (const auto& l : f.scans[0]->anatomy.landmarks) {
    auto& row = rows.emplace_back(std::vector<std::string>{page::escaped(l.name)});
    for (const auto* scan : f.scans)
      for (const auto& other : scan->anatomy.landmarks)
        if (other.name == l.name) row.push_back(with_decimals(other.s / mm));
  }
  return page::table(head, rows, "Where branches leave, along the line of each scan");
}

// --- what was computed ----------------------------------------------------------------------------------------------

struct LoadText {
  const char *title, *unit;
  std::vector<double> StationLoads::*values;
  double size;  ///< of the unit
};

std::vector<LoadText> loads_shown() {
  return {{"Wall stress", "kPa", &StationLoads::stress, 1e3},
          {"TAWSS", "Pa", &StationLoads::tawss, 1},
          {"Pressure, true less false lumen", "mmHg", &StationLoads::pressure_difference,
           config::unit_factor("mmHg", config::dimension::pressure)}};
}

std::string load_plot(const FollowUpFindings& f, const LoadText& load) {
  std::vector<drawing::Series> series;
  for (std::size_t k = 0; k < f.scans.size(); ++k) {
    if (!f.loads[k]) continue;
    auto& s = series.emplace_back(drawing::Series{.name = f.plan.scans[k].name, .x = distances(f), .y = {}});
    for (const double v : *f.loads[k].*load.values) s.y.push_back(v / load.size);
  }
  return plot(series, load.title, fmt::format("{} [{}]", load.title, load.unit));
}

/// Growth over what was computed on the scan before it, a mark for each station.
std::string scatter(const FollowUpFindings& f, const LoadText& load) {
  std::vector<drawing::Series> series;
  bool some = false;
  for (const auto& i : f.intervals) {
    if (!f.loads[i.from]) continue;
    auto& s = series.emplace_back(drawing::Series{.name = i.name, .x = {}, .y = {}, .line = false, .markers = true});
    for (std::size_t k = 0; k < i.diameter.size(); ++k) {
      const double value = (*f.loads[i.from].*load.values)[k];
      if (!std::isfinite(value) || !std::isfinite(i.diameter[k])) continue;
      s.x.push_back(value / load.size);
      s.y.push_back(i.diameter[k] / mm / i.years);
      some = true;
    }
  }
  if (!some) return "";
  return page::drawing(drawing::draw_plot(series, {.title = fmt::format("Growth over {}", load.title),
                                                   .x_label = fmt::format("{} [{}]", load.title, load.unit),
                                                   .y_label = "growth of the diameter [mm/year]",
                                                   .width = 480,
                                                   .height = 360}));
}

std::string correlations_table(const FollowUpFindings& f) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& c : f.correlations)
    rows.push_back({page::escaped(c.interval), c.growth, c.load, with_decimals(c.rank.value, 2),
                    fmt::format("{} to {}", with_decimals(c.rank.low, 2), with_decimals(c.rank.high, 2)),
                    std::to_string(c.rank.pairs)});
  return page::table(
      {"interval", "growth of", "beside", "rank correlation", "95 %", "stations"}, rows,
      fmt::format("Spearman's rank correlation of growth per year with what was computed on the scan before it; "
                  "intervals from 2000 samples of blocks of {} neighbouring stations, about a diameter",
                  f.block));
}

std::string computed_part(const FollowUpFindings& f) {
  if (f.correlations.empty()) return "";
  std::string text = "<h2>Growth beside what was computed</h2>\n" + correlations_table(f);
  for (const auto& load : loads_shown()) text += scatter(f, load);
  for (const auto& load : loads_shown()) text += load_plot(f, load);
  return text;
}

}  // namespace

std::string follow_up_page(const FollowUpFindings& f) {
  const std::string& title = f.plan.settings.title;
  std::string dates;
  for (const auto& scan : f.plan.scans)
    dates += fmt::format("{}{} ({})", dates.empty() ? "" : ", ", page::escaped(scan.name), scan.date);
  return page::begin(fmt::format("Follow-up{}{}", title.empty() ? "" : ": ", title)) +
         fmt::format(
             "<p>{}. Places are told along the aorta of the first scan, from {:.0f} to {:.0f} mm, which all scans "
             "reach; between branches lengths are stretched evenly. Values are in stations.csv and growth.csv, growth "
             "on the surface in growth.vtp.</p>\n",
             dates, f.growth.range[0] / mm, f.growth.range[1] / mm) +
         intervals_table(f) + growth_plot(f) + segments_table(f) + tears_table(f) + computed_part(f) +
         "<h2>Shape</h2>\n" + shape_plots(f) + branches_table(f) + page::end();
}

}  // namespace tunica::pipeline
