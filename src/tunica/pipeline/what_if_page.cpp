#include "tunica/pipeline/what_if_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tunica/base/limits.hpp"
#include "tunica/config/document.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/side_by_side.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
namespace page = drawing::page;
using nlohmann::json;

using base::nan;

/// The case and its variants, by name.
struct Computed {
  std::vector<std::string> names;
  std::vector<json> post;
  std::vector<std::map<std::string, double>> figures;
};

double distance_of_tears(const json& a, const json& b) {
  double squares = 0;
  for (std::size_t d = 0; d < 3; ++d)
    squares += std::pow(a.at("centre_mm").at(d).get<double>() - b.at("centre_mm").at(d).get<double>(), 2);
  return std::sqrt(squares);
}

/// Tears are numbered along the aorta: where one is closed or opened, those behind it have other numbers. In a variant
/// they get the names that tears at their places have in the case, and new ones those of opened ones.
void name_tears_as_in(const json& of_case, json& post) {
  constexpr double same_place = 10;  // mm
  if (!post.contains("tears")) return;
  std::vector<json*> unnamed;
  for (auto& tear : post["tears"]) unnamed.push_back(&tear);
  for (const auto& known : of_case.value("tears", json::array())) {
    const auto nearest = std::min_element(unnamed.begin(), unnamed.end(), [&](const json* a, const json* b) {
      return distance_of_tears(*a, known) < distance_of_tears(*b, known);
    });
    if (nearest == unnamed.end() || distance_of_tears(**nearest, known) > same_place) continue;
    (**nearest)["name"] = known.at("name");
    unnamed.erase(nearest);
  }
  for (std::size_t k = 0; k < unnamed.size(); ++k) (*unnamed[k])["name"] = fmt::format("opened_{}", k + 1);
}

Computed read_all(const WhatIfPlan& plan, const Chain& chain) {
  Computed all;
  const auto add = [&](const std::string& name, const fs::path& file) {
    all.names.push_back(name);
    all.post.push_back(read_json(file));
    name_tears_as_in(all.post.front(), all.post.back());
    all.figures.push_back(figures_in(all.post.back()));
  };
  add("as it is", folder_of(chain, stage("post")) / "post.json");
  for (std::size_t k = 0; k < plan.settings.variants.size(); ++k)
    add(plan.settings.variants[k].first, plan.folder_of(k) / "post/post.json");
  return all;
}

/// Mean over the stations that have a false lumen.
double over_dissection(const json& post, const char* part, const char* figure) {
  double sum = 0;
  int count = 0;
  for (const auto& station : post.value("stations", json::array())) {
    if (!station.contains("true_minus_false_pressure") || !station.contains(part)) continue;
    const auto& of_part = std::string(part) == "true_minus_false_pressure" ? station[part] : station[part]["pressure"];
    sum += of_part.at(figure).get<double>();
    ++count;
  }
  return count > 0 ? sum / count : nan;
}

/// Largest flow along the false lumen at any station, over the beat's mean.
double flow_along_false_lumen(const json& post) {
  double largest = nan;
  for (const auto& station : post.value("stations", json::array()))
    if (station.contains("false_lumen")) {
      const double flow = station["false_lumen"].at("flow_downstream_mean_ml_s").get<double>();
      if (!(std::abs(flow) <= std::abs(largest))) largest = flow;
    }
  return largest;
}

/// What a reader asks first.
std::vector<ComparedLine> main_lines(const Computed& all) {
  std::vector<ComparedLine> lines = {{"pressure in the false lumen", "mmHg", {}},
                                     {"pressure in the true lumen beside it", "mmHg", {}},
                                     {"true less false lumen pressure", "mmHg", {}},
                                     {"largest mean flow along the false lumen", "ml/s", {}}};
  for (const auto& post : all.post) {
    lines[0].values.push_back(over_dissection(post, "false_lumen", "mean_mmHg"));
    lines[1].values.push_back(over_dissection(post, "true_lumen", "mean_mmHg"));
    lines[2].values.push_back(over_dissection(post, "true_minus_false_pressure", "mean_mmHg"));
    lines[3].values.push_back(flow_along_false_lumen(post));
  }
  return lines;
}

/// "openings/lumen_inlet/pressure/mean_mmHg": its unit, as far as it stands in the last word.
std::string unit_of(const std::string& path) {
  for (const auto& [ending, unit] :
       {std::pair{"_mmHg", "mmHg"}, {"_ml_s", "ml/s"}, {"_ml", "ml"}, {"_mm2", "mm^2"}, {"_mm", "mm"}})
    if (path.ends_with(ending)) return unit;
  for (const auto& [part, unit] : {std::pair{"_kPa/", "kPa"}, {"_Pa/", "Pa"}})
    if (path.find(part) != std::string::npos) return unit;
  return "";
}

std::vector<ComparedLine> all_lines(const Computed& all) {
  std::map<std::string, ComparedLine> lines;
  for (std::size_t k = 0; k < all.names.size(); ++k)
    for (const auto& [path, value] : all.figures[k]) {
      if (!fits_any(default_quantities(), path) || path.starts_with("stations/")) continue;
      auto& line =
          lines.try_emplace(path, ComparedLine{path, unit_of(path), std::vector<double>(all.names.size(), nan)})
              .first->second;
      line.values[k] = value;
    }
  std::vector<ComparedLine> list;
  for (auto& [path, line] : lines) list.push_back(std::move(line));
  return list;
}

std::string plot_along(const Computed& all, const std::string& title, const std::string& y_label,
                       const std::function<double(const json&)>& value) {
  std::vector<drawing::Series> series;
  bool some = false;
  for (std::size_t k = 0; k < all.names.size(); ++k) {
    auto& s = series.emplace_back(drawing::Series{.name = all.names[k], .x = {}, .y = {}});
    for (const auto& station : all.post[k].value("stations", json::array())) {
      s.x.push_back(station.at("distance_mm").get<double>());
      s.y.push_back(value(station));
      some = some || std::isfinite(s.y.back());
    }
  }
  if (!some) return "";
  return page::drawing(
      drawing::draw_plot(series, {.title = title, .x_label = "distance along the aorta [mm]", .y_label = y_label}));
}

std::string plots(const Computed& all) {
  const auto of_lumen = [](const char* lumen, const char* figure) {
    return [lumen, figure](const json& station) {
      if (!station.contains(lumen)) return nan;
      return std::string(figure) == "flow" ? station[lumen].at("flow_downstream_mean_ml_s").get<double>()
                                           : station[lumen].at("pressure").at("mean_mmHg").get<double>();
    };
  };
  return plot_along(all, "Pressure, true less false lumen, mean over the beat", "pressure [mmHg]",
                    [](const json& station) {
                      return station.contains("true_minus_false_pressure")
                                 ? station["true_minus_false_pressure"].at("mean_mmHg").get<double>()
                                 : nan;
                    }) +
         plot_along(all, "Mean pressure in the false lumen", "pressure [mmHg]", of_lumen("false_lumen", "pressure")) +
         plot_along(all, "Mean pressure in the true lumen", "pressure [mmHg]", of_lumen("true_lumen", "pressure")) +
         plot_along(all, "Mean flow along the false lumen", "flow [ml/s]", of_lumen("false_lumen", "flow"));
}

/// What each variant is, and what that did to its mesh.
std::string variants(const WhatIfPlan& plan, const std::map<std::string, std::vector<std::string>>& remarks) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, variant] : plan.settings.variants) {
    std::string done;
    if (const auto found = remarks.find(name); found != remarks.end())
      for (const auto& remark : found->second) done += (done.empty() ? "" : "<br>") + page::escaped(remark);
    rows.push_back(
        {page::escaped(name), page::escaped(config::one_line(plan.document.part("variants").part(name))), done});
  }
  return page::table({"variant", "what is other than in the case", "on the mesh"}, rows);
}

}  // namespace

std::string write_what_if(const WhatIfPlan& plan, const Chain& chain,
                          const std::map<std::string, std::vector<std::string>>& remarks) {
  const Computed all = read_all(plan, chain);
  auto lines = main_lines(all);
  const auto first = compared_table(all.names, lines);
  const auto more = all_lines(all);
  lines.insert(lines.end(), more.begin(), more.end());
  write_compared_csv(plan.output / "what_if.csv", all.names, lines);
  const std::string& title = plan.settings.title;
  files::write_atomically(
      plan.output / "what_if.html",
      page::begin(fmt::format("What if{}{}", title.empty() ? "" : ": ", title)) +
          fmt::format(
              "<p>{} as it is, and with other anatomy or loads. Pressures and flows are means over the beat, and "
              "those of lumens over the stations that have both.</p>\n",
              page::escaped(plan.case_file.filename().string())) +
          variants(plan, remarks) + first + plots(all) + "<h2>All figures</h2>\n" + compared_table(all.names, more) +
          page::end());
  return fmt::format("side by side: {}", (plan.output / "what_if.html").string());
}

}  // namespace tunica::pipeline
