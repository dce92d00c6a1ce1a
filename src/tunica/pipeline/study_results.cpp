#include "tunica/pipeline/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "tunica/base/limits.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/study_page.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

using base::nan;

// --- the table ------------------------------------------------------------------------------------------------------

const std::vector<std::string>& patterns_of(const StudyPlan& plan) {
  return plan.study.quantities.empty() ? default_quantities() : plan.study.quantities;
}

std::vector<Quantity> quantities_of(const StudyPlan& plan, const std::vector<PointResult>& results) {
  std::set<std::string> paths;
  for (const auto& r : results)
    for (const auto& [path, value] : r.figures)
      if (fits_any(patterns_of(plan), path)) paths.insert(path);
  std::vector<Quantity> quantities;
  for (const auto& path : paths) {
    auto& q = quantities.emplace_back(Quantity{.path = path, .values = {}});
    for (const auto& r : results) q.values.push_back(r.figures.contains(path) ? r.figures.at(path) : nan);
  }
  return quantities;
}

/// Designs that cover all ranges at random say which key matters; those of Saltelli say how much.
void find_sensitivities(const StudyPlan& plan, std::vector<Quantity>& quantities) {
  const auto& design = plan.study.design;
  if (const auto* saltelli = std::get_if<case_file::SaltelliDesign>(&design)) {
    for (auto& q : quantities)
      q.indices = analysis::sobol_indices(q.values, static_cast<std::size_t>(saltelli->points), plan.axes.size());
    return;
  }
  if (!std::holds_alternative<case_file::LatinHypercubeDesign>(design) &&
      !std::holds_alternative<case_file::SobolDesign>(design))
    return;
  for (std::size_t k = 0; k < plan.axes.size(); ++k) {
    std::vector<double> x;
    for (const auto& point : plan.points) x.push_back(point.numbers[k]);
    for (auto& q : quantities) q.rank_correlation.push_back(analysis::rank_correlation(x, q.values));
  }
}

std::string csv_of(const StudyPlan& plan, const std::vector<Quantity>& quantities,
                   const std::vector<PointResult>& results) {
  std::string csv = "point";
  for (const auto& axis : plan.axes) csv += fmt::format(",{}", csv_cell(axis.label()));
  for (const auto& q : quantities) csv += fmt::format(",{}", csv_cell(q.path));
  csv += ",status,seconds,error\n";
  for (std::size_t k = 0; k < results.size(); ++k) {
    csv += fmt::format("{}", k + 1);
    for (std::size_t d = 0; d < plan.axes.size(); ++d)
      csv += fmt::format(",{}", plan.axes[d].numeric ? fmt::format("{:.10g}", plan.points[k].numbers[d])
                                                     : csv_cell(plan.points[k].values[d]));
    for (const auto& q : quantities) csv += fmt::format(",{:.10g}", q.values[k]);
    csv +=
        fmt::format(",{},{:.1f},{}\n", results[k].state.status, results[k].seconds, csv_cell(results[k].state.message));
  }
  return csv;
}

ordered_json point_json(const StudyPlan& plan, std::size_t k, const std::vector<Quantity>& quantities,
                        const PointResult& result) {
  ordered_json page = {{"point", k + 1}, {"status", result.state.status}, {"seconds", result.seconds}};
  if (!result.state.message.empty()) page["error"] = result.state.message;
  for (std::size_t d = 0; d < plan.axes.size(); ++d) page["values"][plan.axes[d].key] = plan.points[k].values[d];
  for (const auto& q : quantities)
    if (std::isfinite(q.values[k])) page["quantities"][q.path] = q.values[k];
  return page;
}

ordered_json index_json(const analysis::SobolIndex& index) {
  return {{"first", finite_or_null(index.first)},
          {"first_error", finite_or_null(index.first_error)},
          {"total", finite_or_null(index.total)},
          {"total_error", finite_or_null(index.total_error)}};
}

ordered_json json_of(const StudyPlan& plan, const std::vector<Quantity>& quantities,
                     const std::vector<PointResult>& results) {
  ordered_json page = {{"study", plan.file.filename().string()},
                       {"case", plan.study.case_file.filename().string()},
                       {"design", design_text(plan.study.design)}};
  for (const auto& axis : plan.axes) page["keys"].push_back({{"key", axis.key}, {"unit", axis.unit}});
  page["points"] = ordered_json::array();
  for (std::size_t k = 0; k < results.size(); ++k)
    page["points"].push_back(point_json(plan, k, quantities, results[k]));
  for (const auto& q : quantities)
    for (std::size_t d = 0; d < plan.axes.size(); ++d) {
      const std::string& key = plan.axes[d].key;
      if (!q.rank_correlation.empty()) page["rank_correlation"][q.path][key] = finite_or_null(q.rank_correlation[d]);
      if (q.indices) page["sobol_indices"][q.path][key] = index_json(q.indices->of[d]);
      if (q.indices) page["sobol_rows"][q.path] = q.indices->rows;
    }
  return page;
}

std::vector<std::string> remarks(const StudyPlan& plan, const std::vector<PointResult>& results) {
  std::map<std::string, int> counts;
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < results.size(); ++k) {
    ++counts[results[k].state.status];
    if (results[k].state.status == "failed")
      lines.push_back(fmt::format("{} failed: {}", plan.name_of(k), results[k].state.message));
  }
  for (const auto& pattern : patterns_of(plan)) {
    if (plan.study.quantities.empty() || counts["done"] == 0) break;
    const bool found = std::any_of(results.begin(), results.end(), [&](const PointResult& r) {
      return std::any_of(r.figures.begin(), r.figures.end(),
                         [&](const auto& figure) { return fits_any({pattern}, figure.first); });
    });
    if (!found)
      lines.push_back(
          fmt::format("warning: quantities: `{}` fits no figure; see the paths in {}, such as "
                      "openings/lumen_inlet/pressure/mean_mmHg",
                      pattern, post_json(plan.cases[0]).string()));
  }
  std::string sum;
  for (const auto& [status, count] : counts)
    if (count > 0) sum += fmt::format("{}{} {}", sum.empty() ? "" : ", ", count, status);
  lines.push_back(fmt::format("\n{} points: {}", results.size(), sum));
  lines.push_back(fmt::format("study: {}", (plan.output / "study.html").string()));
  return lines;
}

}  // namespace

std::vector<PointResult> read_results(const StudyPlan& plan) {
  std::vector<PointResult> results;
  for (const auto& point : plan.cases) {
    PointResult result{.state = read_state(point)};
    if (result.state.status == "done" && !fs::exists(post_json(point))) result.state = {"pending", ""};
    if (result.state.status != "pending") result.seconds = seconds_of(point);
    if (result.state.status == "done") result.figures = read_figures(post_json(point));
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<std::string> write_study(const StudyPlan& plan, const std::vector<PointResult>& results) {
  auto quantities = quantities_of(plan, results);
  find_sensitivities(plan, quantities);
  files::write_atomically(plan.output / "study.csv", csv_of(plan, quantities, results));
  files::write_atomically(plan.output / "study.json", config::json_text(json_of(plan, quantities, results)));
  files::write_atomically(plan.output / "study.html", study_page(plan, quantities, results));
  return remarks(plan, results);
}

}  // namespace tunica::pipeline
