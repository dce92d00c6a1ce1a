// Curves of a page, from the tables of a run and of its figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "tunica/artifacts/histories.hpp"
#include "tunica/base/units.hpp"
#include "tunica/config/units.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/stages/beat.hpp"

namespace tunica::stages {

namespace {

namespace fs = std::filesystem;
namespace dimension = config::dimension;
using files::CsvColumns;
using viewer::Curve;
using viewer::Plot;

constexpr std::size_t most_stations = 6;  ///< curves of stations in one plot

std::optional<CsvColumns> table(const fs::path& folder, const char* name) {
  if (folder.empty() || !fs::exists(folder / name)) return std::nullopt;
  return files::read_csv(folder / name, "do the stage anew that has written it", files::Gaps::allowed);
}

std::string shown(std::string name) {
  if (name.starts_with("lumen_")) name = name.substr(6);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

struct Opening {
  std::string name;
  bool inlet = false;
};

/// Those of the figures; without figures all faces that blood passes, and the inlet is where most of it comes in.
std::vector<Opening> openings_of(const nlohmann::json& post, const CsvColumns& faces) {
  std::vector<Opening> openings;
  if (post.is_object() && post.contains("openings")) {
    for (const auto& o : post["openings"]) openings.push_back({o.at("name"), o.value("inlet", false)});
    return openings;
  }
  const std::string ending = " flow [";
  std::vector<double> largest, mean;
  for (std::size_t k = 0; k < faces.headers.size(); ++k)
    if (const auto at = faces.headers[k].find(ending); at != std::string::npos) {
      const auto& flow = faces.columns[k];
      openings.push_back({faces.headers[k].substr(0, at)});
      mean.push_back(std::accumulate(flow.begin(), flow.end(), 0.0));
      largest.push_back(std::abs(
          *std::max_element(flow.begin(), flow.end(), [](double a, double b) { return std::abs(a) < std::abs(b); })));
    }
  if (openings.empty()) return openings;
  openings[static_cast<std::size_t>(std::min_element(mean.begin(), mean.end()) - mean.begin())].inlet = true;
  const double still = 1e-6 * *std::max_element(largest.begin(), largest.end());
  std::vector<Opening> passed;
  for (std::size_t k = 0; k < openings.size(); ++k)
    if (largest[k] > still) passed.push_back(openings[k]);
  return passed;
}

void keep_window(const nlohmann::json& post, const std::vector<double>& times, Curve& curve) {
  const bool all = !post.is_object() || !post.contains("window");
  const double from = all ? times.front() : post["window"].at("from_s").get<double>(),
               until = all ? times.back() : post["window"].at("until_s").get<double>();
  const double margin = 1e-6 * (until - from);
  std::vector<double> y;
  for (std::size_t k = 0; k < times.size(); ++k)
    if (times[k] >= from - margin && times[k] <= until + margin) curve.x.push_back(times[k]), y.push_back(curve.y[k]);
  curve.y = std::move(y);
}

/// Flow is positive the way that blood goes: into the vessel at the inlet, out of it elsewhere.
void add_openings(const fs::path& results, const nlohmann::json& post, std::vector<Plot>& plots) {
  const auto faces = table(results, "faces.csv");
  if (!faces || faces->columns.empty() || faces->columns[0].size() < 2) return;
  const auto times = artifacts::si_column(*faces, "time", dimension::time);
  Plot pressure{"Pressure at the openings", "time [s]", "pressure [mmHg]", true, {}},
      flow{"Flow at the openings, in at the inlet and out at the others", "time [s]", "flow [ml/s]", true, {}};
  const auto openings = openings_of(post, *faces);
  for (std::size_t k = 0; k < openings.size(); ++k) {
    const auto& [name, inlet] = openings[k];
    Curve p{
        shown(name), {}, artifacts::si_column(*faces, name + " pressure", dimension::pressure), static_cast<int>(k)},
        q{shown(name), {}, artifacts::si_column(*faces, name + " flow", dimension::volume_flow), static_cast<int>(k)};
    for (auto& v : p.y) v /= unit::mmHg;
    for (auto& v : q.y) v *= (inlet ? -1 : 1) / unit::ml;
    keep_window(post, times, p);
    keep_window(post, times, q);
    pressure.curves.push_back(std::move(p));
    flow.curves.push_back(std::move(q));
  }
  plots.push_back(std::move(pressure));
  plots.push_back(std::move(flow));
}

/// "name [unit]" without its unit.
std::string without_unit(const std::string& header) { return header.substr(0, header.find(" [")); }

/// Columns that `wanted` accepts, over the first one.
template <class Wanted>
void add_columns(const std::optional<CsvColumns>& t, Plot plot, const Wanted& wanted, std::vector<Plot>& plots) {
  if (!t || t->columns.empty() || t->columns[0].size() < 2) return;
  for (std::size_t k = 1; k < t->headers.size(); ++k)
    if (const auto name = wanted(t->headers[k], k); !name.empty())
      plot.curves.push_back({name, t->columns[0], t->columns[k], static_cast<int>(plot.curves.size())});
  if (!plot.curves.empty()) plots.push_back(std::move(plot));
}

void add_in_time(const fs::path& post, std::vector<Plot>& plots) {
  const auto difference = table(post, "pressure_difference.csv");
  const std::size_t every = difference ? (difference->headers.size() + most_stations - 2) / most_stations : 1;
  add_columns(
      difference,
      {"Pressure of the true less that of the false lumen, by distance from the inlet",
       "time [s]",
       "pressure difference [mmHg]",
       true,
       {}},
      [&](const std::string& header, std::size_t k) {
        return (k - 1) % std::max<std::size_t>(every, 1) == 0 ? without_unit(header) : "";
      },
      plots);
  add_columns(
      table(post, "tears.csv"), {"Flow through the tears, into the false lumen", "time [s]", "flow [ml/s]", true, {}},
      [](const std::string& header, std::size_t) {
        const bool tear = header.find(" flow [ml/s]") != std::string::npos;
        if (tear) return shown(header.substr(0, header.find(" flow [")));
        return header.find("dV/dt") != std::string::npos ? std::string("dV/dt of the false lumen") : std::string();
      },
      plots);
  add_columns(
      table(post, "flap.csv"), {"Displacement of the flap since the start", "time [s]", "displacement [mm]", true, {}},
      [](const std::string& header, std::size_t) { return header.substr(0, header.find(" displacement")); }, plots);
  add_columns(
      table(post, "stress.csv"),
      {"Von Mises stress that 99 % of a region stay below", "time [s]", "stress [kPa]", true, {}},
      [](const std::string& header, std::size_t) {
        const auto at = header.find(" von Mises stress p99 [");
        return at == std::string::npos ? std::string() : shown(header.substr(0, at));
      },
      plots);
}

void add_along(const fs::path& post, std::vector<Plot>& plots) {
  const auto stations = table(post, "stations.csv");
  if (!stations || stations->columns.empty() || stations->columns[0].size() < 2) return;
  const auto& distance = stations->columns[0];
  const auto column = [&](const std::string& name) -> const std::vector<double>* {
    for (std::size_t k = 0; k < stations->headers.size(); ++k)
      if (stations->headers[k].starts_with(name + " [")) return &stations->columns[k];
    return nullptr;
  };
  const bool two = column("false pressure mean") != nullptr;
  for (const auto& [what, label] :
       {std::pair{"pressure", "pressure [mmHg]"}, {"flow", "flow downstream [ml/s]"}, {"area", "area [mm²]"}}) {
    Plot plot{fmt::format("{} along the aorta: mean of the beat, and its extremes", what),
              "distance from the inlet [mm]",
              label,
              false,
              {}};
    plot.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title[0])));
    for (int lumen = 0; lumen < (two ? 2 : 1); ++lumen)
      for (const char* statistic : {"mean", "largest", "smallest"})
        if (const auto* y = column(fmt::format("{} {} {}", lumen == 0 ? "true" : "false", what, statistic))) {
          const bool mean = statistic == std::string("mean"), largest = statistic == std::string("largest");
          const std::string name = two ? (lumen == 0 ? "true lumen" : "false lumen") : "lumen";
          plot.curves.push_back({mean ? name : fmt::format("{}, {}", name, statistic), distance, *y,
                                 lumen + (mean      ? 0
                                          : largest ? 7
                                                    : 14)});
        }
    plots.push_back(std::move(plot));
  }
}

}  // namespace

std::vector<Plot> collect_plots(const BeatSource& source, const fs::path& post) {
  std::vector<Plot> plots;
  add_openings(source.results, source.post, plots);
  add_in_time(post, plots);
  add_along(post, plots);
  return plots;
}

}  // namespace tunica::stages
