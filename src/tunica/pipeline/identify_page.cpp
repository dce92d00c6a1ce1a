#include "tunica/pipeline/identify_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/pipeline/figures.hpp"

namespace tunica::pipeline {

namespace {

namespace page = drawing::page;

std::string range_text(double low, double high) { return fmt::format("{} to {}", figure_text(low), figure_text(high)); }

std::string parameters_table(const IdentifyPlan& plan, const Identified& found) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    const auto& p = plan.parameters[k];
    std::string keys = p.is_factor() ? "factor on " : "";
    for (const auto& key : p.keys) keys += (key == p.keys.front() ? "" : ", ") + key;
    rows.push_back({page::escaped(p.name), page::escaped(keys), page::escaped(p.unit), figure_text(p.start),
                    fmt::format("<b>{}</b>", figure_text(found.values()[k])), found.interval_text(k),
                    range_text(p.low, p.high)});
  }
  return page::table({"parameter", "keys", "unit", "start", "found", "95 % interval", "bounds"}, rows);
}

std::string correlation_table(const IdentifyPlan& plan, const Identified& found) {
  const std::size_t n = plan.parameters.size();
  if (!found.estimates || n < 2) return "";
  std::vector<std::string> head = {"parameter"};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < n; ++i) {
    head.push_back(page::escaped(plan.parameters[i].name));
    auto& row = rows.emplace_back(std::vector<std::string>{head.back()});
    for (std::size_t j = 0; j < n; ++j) row.push_back(fmt::format("{:.3f}", found.estimates->correlation[i][j]));
  }
  return page::table(head, rows, "Correlation of the errors of two parameters: near 1 or -1 they are not told apart");
}

std::string remarks_list(const IdentifyPlan& plan, const Identified& found) {
  std::string items;
  for (const auto& line : undetermined(plan, found)) items += fmt::format("<li>{}</li>\n", page::prose(line));
  return items.empty() ? "" : fmt::format("<ul>\n{}</ul>\n", items);
}

std::string misfits_table(const IdentifyPlan& plan, const Identified& found) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < plan.measurements.size(); ++k) {
    const auto& m = plan.measurements[k];
    rows.push_back({page::escaped(m.path()), m.curve ? "curve" : "values", figure_text(m.independent),
                    figure_text(found.first[k].misfit()), figure_text(found.last[k].misfit())});
  }
  rows.push_back({"all", "", figure_text(plan.independent()), figure_text(found.runs.front().misfit),
                  figure_text(found.runs[found.best].misfit)});
  return page::table(
      {"measurement", "given as", "independent values", "misfit at the start", "misfit at the end"}, rows,
      "Misfits are root mean squares of computed less measured, in standard deviations of the measurement");
}

std::string values_table(const IdentifyPlan& plan, const Identified& found) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < plan.measurements.size(); ++k) {
    const auto &first = found.first[k], &last = found.last[k];
    for (std::size_t i = 0; i < first.what.size(); ++i)
      rows.push_back({page::escaped(plan.measurements[k].path()), first.what[i],
                      page::escaped(plan.measurements[k].kind->unit), figure_text(first.measured[i]),
                      figure_text(first.deviations[i]), figure_text(first.computed[i]), figure_text(last.computed[i])});
  }
  if (rows.empty()) return "";
  return page::table({"measurement", "value", "unit", "measured", "deviation", "computed at the start", "at the end"},
                     rows);
}

std::string curve_plot(const ChosenMeasurement& m, const HeldAgainst& first, const HeldAgainst& last) {
  drawing::Series points{
      .name = "measured", .x = first.times, .y = first.measured, .line = false, .markers = true, .colour = 1};
  drawing::Series low{.name = "one standard deviation", .x = first.times, .dashed = true, .colour = 1},
      high{.x = first.times, .dashed = true, .colour = 1};
  for (std::size_t k = 0; k < first.times.size(); ++k) {
    low.y.push_back(first.measured[k] - first.deviations[k]);
    high.y.push_back(first.measured[k] + first.deviations[k]);
  }
  const drawing::Series start{.name = "first run", .x = first.times, .y = first.computed, .colour = 2},
      end{.name = "best run", .x = last.times, .y = last.computed, .colour = 0};
  return page::drawing(drawing::draw_plot({start, end, points, low, high},
                                          {.title = m.path(),
                                           .x_label = "time since the start of the beat [s]",
                                           .y_label = fmt::format("{} [{}]", m.kind->quantity, m.kind->unit)}));
}

std::string misfit_plot(const Identified& found) {
  drawing::Series all{.name = "run", .line = false, .markers = true, .hollow = true, .colour = 2},
      lowest{.name = "lowest so far", .markers = true, .colour = 0};
  for (std::size_t k = 0; k < found.runs.size(); ++k) {
    const auto& run = found.runs[k];
    if (!std::isfinite(run.misfit)) continue;
    all.x.push_back(static_cast<double>(k + 1));
    all.y.push_back(run.misfit);
    if (!run.lowest) continue;
    lowest.x.push_back(all.x.back());
    lowest.y.push_back(run.misfit);
  }
  return page::drawing(drawing::draw_plot(
      {lowest, all}, {.title = "Misfit", .x_label = "run", .y_label = "root mean square [deviations]", .log_y = true}));
}

std::string plots_of_runs(const IdentifyPlan& plan, const Identified& found) {
  std::string all = misfit_plot(found);
  for (std::size_t k = 0; k < plan.measurements.size(); ++k)
    if (plan.measurements[k].curve) all += curve_plot(plan.measurements[k], found.first[k], found.last[k]);
  return all;
}

std::string runs_table(const IdentifyPlan& plan, const Identified& found) {
  std::vector<std::string> head = {"run", "purpose"};
  for (const auto& p : plan.parameters) head.push_back(page::escaped(p.label()));
  for (const char* cell : {"misfit", "status", "seconds", "error"}) head.emplace_back(cell);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < found.runs.size(); ++k) {
    const auto& run = found.runs[k];
    auto& row =
        rows.emplace_back(std::vector<std::string>{std::to_string(k + 1), page::escaped(purpose_of(plan, run))});
    for (const double value : run.values) row.push_back(fmt::format("{:.6g}", value));
    row.push_back(figure_text(run.misfit));
    row.push_back(run.state.status);
    row.push_back(fmt::format("{:.1f}", run.seconds));
    row.push_back(page::escaped(run.state.message));
  }
  return page::table(head, rows);
}

}  // namespace

std::string identify_page(const IdentifyPlan& plan, const Identified& found) {
  const std::string& title = plan.settings.title;
  return page::begin(fmt::format("Identification{}{}", title.empty() ? "" : ": ", title)) +
         fmt::format("<p>Values of {} of {} that bring what is computed closest to what was measured. {}</p>\n",
                     plan.parameters.size() == 1 ? "a parameter" : "parameters",
                     page::escaped(plan.settings.case_file.filename().string()), page::prose(found.ending)) +
         parameters_table(plan, found) + remarks_list(plan, found) + correlation_table(plan, found) +
         misfits_table(plan, found) + values_table(plan, found) + plots_of_runs(plan, found) + "<h2>All runs</h2>\n" +
         runs_table(plan, found) + page::end();
}

}  // namespace tunica::pipeline
