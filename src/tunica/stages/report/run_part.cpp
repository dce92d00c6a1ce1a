// The run: how it went, and its curves where no figures of a cycle are there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/artifacts/histories.hpp"
#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/stages/report/parts.hpp"

namespace tunica::stages::report {

namespace {

namespace fs = std::filesystem;
constexpr const char* run_remedy = "do the stage `run` anew";

std::size_t column_with(const files::CsvColumns& table, const std::string& text) {
  const auto at = std::find_if(table.headers.begin(), table.headers.end(),
                               [&](const auto& header) { return header.find(text) != std::string::npos; });
  return static_cast<std::size_t>(at - table.headers.begin());
}

std::string unit_of(const std::string& header) {
  const auto begin = header.rfind('[');
  return begin == std::string::npos ? "" : header.substr(begin);
}

/// All columns whose header ends in " <what> [unit]".
std::string curves(const files::CsvColumns& table, const std::string& what, const std::string& title) {
  std::vector<drawing::Series> series;
  std::string unit;
  const std::size_t time = column_with(table, "time");
  if (time == table.headers.size()) return "";
  for (std::size_t k = 0; k < table.headers.size(); ++k) {
    const auto at = table.headers[k].find(" " + what + " [");
    if (at == std::string::npos) continue;
    unit = unit_of(table.headers[k]);
    series.push_back({.name = table.headers[k].substr(0, at), .x = table.columns[time], .y = table.columns[k]});
  }
  if (series.empty() || table.columns[time].size() < 2) return "";
  return drawing::page::drawing(drawing::draw_plot(
      series, {.title = title, .x_label = table.headers[time], .y_label = what + " " + unit, .width = 560}));
}

std::string curve(const files::CsvColumns& table, const std::string& column, const std::string& title) {
  const std::size_t k = column_with(table, column), time = column_with(table, "time");
  if (k == table.headers.size() || time == table.headers.size() || table.columns[time].size() < 2) return "";
  return drawing::page::drawing(drawing::draw_plot(
      {{.name = "", .x = table.columns[time], .y = table.columns[k]}},
      {.title = title, .x_label = table.headers[time], .y_label = table.headers[k], .width = 420, .height = 320}));
}

/// What a history lacks of its steps.
std::string gaps(const files::CsvColumns& table) {
  std::string text;
  for (const auto& b : artifacts::breaks_of(table)) text += (text.empty() ? "" : "; ") + b.what;
  return text.empty() ? text : missing(table.file.filename().string(), text);
}

std::string balance(const fs::path& folder) {
  const files::CsvColumns table = files::read_csv(folder / "balance.csv", run_remedy, files::Gaps::allowed);
  std::vector<std::vector<std::string>> rows;
  const auto largest = [&](const std::string& column, const std::string& name) {
    const auto k = column_with(table, column);
    if (k == table.headers.size() || table.columns[k].empty()) return;
    const auto at = std::max_element(table.columns[k].begin(), table.columns[k].end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
    rows.push_back({name + " " + unit_of(table.headers[k]), fmt::format("{:.4g}", std::abs(*at))});
  };
  largest("max displacement", "largest displacement");
  largest("max velocity", "largest velocity");
  largest("relative mass residual", "largest mass residual, of the largest flow");
  largest("interface power residual", "largest residual of the power at the interface");
  return gaps(table) + drawing::page::table({"of all steps", ""}, rows) +
         curve(table, "max displacement", "Largest displacement");
}

std::string times(const fs::path& folder) {
  const files::CsvColumns table = files::read_csv(folder / "steps.csv", run_remedy, files::Gaps::allowed);
  std::vector<std::vector<std::string>> rows;
  for (const char* what : {"newton iterations", "linear iterations", "mesh iterations", "assembly", "set-up",
                           "linear [", "mesh [", "total"}) {
    const auto k = column_with(table, what);
    if (k == table.headers.size() || table.columns[k].empty()) continue;
    const auto& values = table.columns[k];
    rows.push_back(
        {drawing::page::escaped(table.headers[k]),
         fmt::format("{:.3g}", std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size())),
         fmt::format("{:.3g}", *std::max_element(values.begin(), values.end()))});
  }
  return gaps(table) + drawing::page::table({"of a step", "mean", "largest"}, rows) +
         curve(table, "total", "Seconds of each step") +
         curve(table, "newton iterations", "Newton iterations of each step");
}

std::string runs(const json& manifest) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& run : manifest.at("runs"))
    rows.push_back({figure(run.value("status", json())), figure(run.value("last_step", json())),
                    figure(run.value("rejected_steps", json())), figure(run.value("ranks", json())),
                    figure(run.contains("seconds") ? run["seconds"].value("total", json()) : json()),
                    figure(run.value("peak_memory_MB", json()), 3)});
  const json& last = manifest.at("runs").back();
  const std::string dissipation = last.contains("dissipation") ? dissipation_table(last["dissipation"]) : "";
  return drawing::page::table({"run", "to step", "steps rejected", "ranks", "seconds", "memory [MB]"}, rows) +
         dissipation;
}

}  // namespace

std::string run_part(const Results& r) {
  std::string text = "<h2 id=\"run\">Numerics</h2>\n";
  const fs::path folder = r.folder("run");
  if (r.manifest.is_null()) return text + missing("The run", "it is not done");
  const bool has_faces = fs::exists(folder / "faces.csv");
  text += runs(r.manifest);
  if (has_faces && !r.manifest.at("runs").back().contains("dissipation"))
    text += missing("Numerical over viscous dissipation", "the run has not ended, or its version did not tell it");
  text += balance(folder);
  if (has_faces && r.post.is_null()) {
    const files::CsvColumns faces = files::read_csv(folder / "faces.csv", run_remedy, files::Gaps::allowed);
    text += gaps(faces) + curves(faces, "pressure", "Mean pressure at the openings") +
            curves(faces, "flow", "Flow at the openings");
  }
  return text + "<h3>Time steps</h3>\n" + times(folder);
}

}  // namespace tunica::stages::report
