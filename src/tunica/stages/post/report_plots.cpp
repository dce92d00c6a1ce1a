#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tunica/drawing/plot.hpp"
#include "tunica/stages/post/report_files.hpp"
#include "tunica/stages/post/report_json.hpp"

namespace tunica::stages::post {

namespace {

std::vector<double> scaled(std::vector<double> values, double unit) {
  for (auto& v : values) v /= unit;
  return values;
}

/// A palette has seven colours: a plot with more curves than that cannot be read.
constexpr std::size_t most_curves = 7;

class Plots {
 public:
  Plots(const Findings& f, const std::filesystem::path& folder) : f_(f), folder_(folder) {}

  void openings() {
    std::vector<drawing::Series> pressure, flow;
    for (const auto& o : f_.openings) {
      pressure.push_back({.name = o.name, .x = o.times, .y = scaled(o.pressure, unit::mmHg)});
      flow.push_back({.name = o.name, .x = o.times, .y = scaled(o.flow, unit::ml)});
    }
    write("openings_pressure.svg", pressure, "Mean pressure of the openings", "time [s]", "pressure [mmHg]");
    write("openings_flow.svg", flow, "Flow through the openings, outwards", "time [s]", "flow [ml/s]");
  }

  /// Mean over the window and its extremes along the aorta, one curve for each lumen.
  void along(const std::string& file, const char* what, const std::string& title, const std::string& label,
             double unit) {
    std::vector<drawing::Series> series;
    for (std::size_t lumen = 0; lumen < 2; ++lumen) {
      drawing::Series mean{.name = fmt::format("{} lumen", analysis::lumen_names[lumen])}, high{.dashed = true},
          low{.dashed = true};
      if (f_.vessel.side.empty()) mean.name = "lumen";
      mean.colour = high.colour = low.colour = static_cast<int>(lumen);
      for (std::size_t s = 0; s < f_.vessel.stations.size(); ++s) {
        if (f_.vessel.stations[s].sections[lumen].empty()) continue;
        const auto c = analysis::course(f_.times, f_.figures.column(analysis::column::station(s, lumen, what)));
        for (auto* curve : {&mean, &high, &low}) curve->x.push_back(f_.vessel.stations[s].distance / unit::mm);
        mean.y.push_back(c.mean / unit);
        high.y.push_back(c.largest / unit);
        low.y.push_back(c.smallest / unit);
      }
      if (mean.x.empty()) continue;
      for (auto* curve : {&mean, &high, &low}) series.push_back(std::move(*curve));
    }
    write(file, series, title + ": mean, and extremes (dashed)", "distance from the inlet [mm]", label);
  }

  void pressure_difference() {
    drawing::Series mean{.name = "mean"}, high{.name = "largest", .dashed = true},
        low{.name = "smallest", .dashed = true};
    std::vector<drawing::Series> in_time;
    std::vector<std::size_t> both;
    for (std::size_t s = 0; s < f_.vessel.stations.size(); ++s)
      if (!f_.vessel.stations[s].sections[0].empty() && !f_.vessel.stations[s].sections[1].empty()) both.push_back(s);
    if (both.empty()) return;
    const auto every = (both.size() + 4) / 5;
    for (std::size_t k = 0; k < both.size(); ++k) {
      auto difference = f_.figures.column(analysis::column::station(both[k], 0, "pressure"));
      const auto other = f_.figures.column(analysis::column::station(both[k], 1, "pressure"));
      for (std::size_t i = 0; i < other.size(); ++i) difference[i] = (difference[i] - other[i]) / unit::mmHg;
      const auto c = analysis::course(f_.times, difference);
      const double at = f_.vessel.stations[both[k]].distance / unit::mm;
      for (auto* curve : {&mean, &high, &low}) curve->x.push_back(at);
      mean.y.push_back(c.mean);
      high.y.push_back(c.largest);
      low.y.push_back(c.smallest);
      if (k % every == 0) in_time.push_back({.name = fmt::format("{:g} mm", at), .x = f_.times, .y = difference});
    }
    const std::string title = "Pressure of the true less that of the false lumen", label = "difference [mmHg]";
    write("pressure_difference.svg", {mean, high, low}, title, "distance from the inlet [mm]", label);
    write("pressure_difference_in_time.svg", in_time, title, "time [s]", label);
  }

  /// The tears that carry the most, in their order along the aorta.
  void tears() {
    std::vector<drawing::Series> series;
    std::vector<std::pair<double, std::size_t>> by_flow;
    const auto& lumens = *f_.lumens;
    for (const auto& tear : lumens.tears) {
      series.push_back({.name = tear.place.name, .x = lumens.times, .y = scaled(tear.flow, unit::ml)});
      double largest = 0;
      for (const double flow : series.back().y) largest = std::max(largest, std::abs(flow));
      by_flow.emplace_back(largest, by_flow.size());
    }
    std::sort(by_flow.begin(), by_flow.end());
    while (by_flow.size() + 2 > most_curves) {
      series[by_flow.front().second].y.clear();
      by_flow.erase(by_flow.begin());
    }
    std::erase_if(series, [](const drawing::Series& curve) { return curve.y.empty(); });
    series.push_back({.name = "out by openings", .x = lumens.times, .y = scaled(lumens.outflow, unit::ml)});
    series.push_back({.name = "dV/dt of the false lumen",
                      .x = lumens.times,
                      .y = scaled(lumens.volume_rate, unit::ml),
                      .dashed = true});
    write("tears.svg", series, "Flow through the tears into the false lumen", "time [s]", "flow [ml/s]");
  }

  void flap() {
    write(
        "flap.svg",
        {{.name = "mean", .x = f_.times, .y = scaled(f_.figures.column(analysis::column::flap_mean), unit::mm)},
         {.name = "largest", .x = f_.times, .y = scaled(f_.figures.column(analysis::column::flap_largest), unit::mm)}},
        "Displacement of the flap since the start of the window", "time [s]", "displacement [mm]");
  }

  /// The highest percentile of the first quantity, part by part of the wall.
  void stress() {
    std::vector<drawing::Series> series;
    const double p = *std::max_element(f_.settings.percentiles.begin(), f_.settings.percentiles.end());
    const auto& quantity = f_.frames.stresses().front();
    for (const auto& part : f_.frames.wall_parts())
      series.push_back(
          {.name = part.name,
           .x = f_.times,
           .y = scaled(f_.figures.column(analysis::column::stress(part.name, quantity, fmt::format("{:g}", p))),
                       unit::kPa)});
    write("stress.svg", series, fmt::format("{:g} % of the volume lie below", p), "time [s]", quantity + " [kPa]");
  }

  std::vector<std::string> files;

 private:
  void write(const std::string& name, const std::vector<drawing::Series>& series, const std::string& title,
             const std::string& x_label, const std::string& y_label) {
    drawing::write_plot((folder_ / name).string(), series, {.title = title, .x_label = x_label, .y_label = y_label});
    files.push_back(name);
  }

  const Findings& f_;
  const std::filesystem::path& folder_;
};

}  // namespace

std::vector<std::string> write_plots(const Findings& f, const std::filesystem::path& folder) {
  Plots plots(f, folder);
  if (!f.openings.empty()) plots.openings();
  if (f.has_stations()) {
    plots.along("pressure.svg", "pressure", "Pressure along the aorta", "pressure [mmHg]", unit::mmHg);
    plots.along("area.svg", "area", "Cross-section along the aorta", "area [mm^2]", unit::mm2);
    plots.along("flow.svg", "flow", "Flow along the aorta, downstream", "flow [ml/s]", unit::ml);
    plots.pressure_difference();
  }
  if (f.lumens && !f.lumens->tears.empty()) plots.tears();
  if (f.has_flap()) plots.flap();
  if (!f.frames.stresses().empty()) plots.stress();
  return plots.files;
}

}  // namespace tunica::stages::post
