#include "tunica/pipeline/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/drawing/page.hpp"
#include "tunica/drawing/plot.hpp"
#include "tunica/pipeline/figures.hpp"

namespace tunica::pipeline {

namespace {

namespace page = drawing::page;

constexpr std::size_t most_plots = 120;

struct DesignText {
  std::string operator()(const case_file::GridDesign&) const { return "grid"; }
  std::string operator()(const case_file::ListDesign&) const { return "list"; }
  std::string operator()(const case_file::LatinHypercubeDesign& d) const {
    return fmt::format("Latin hypercube of {} points, seed {}", d.points, d.seed);
  }
  std::string operator()(const case_file::SobolDesign& d) const {
    return fmt::format("shifted Sobol sequence of {} points, seed {}", d.points, d.seed);
  }
  std::string operator()(const case_file::SaltelliDesign& d) const {
    return fmt::format("blocks of Saltelli with {} points each, seed {}", d.points, d.seed);
  }
};

std::string points_table(const StudyPlan& plan, const std::vector<Quantity>& quantities,
                         const std::vector<PointResult>& results) {
  std::vector<std::string> head = {"point"};
  for (const auto& axis : plan.axes) head.push_back(page::escaped(axis.label()));
  for (const auto& q : quantities) head.push_back(page::escaped(q.path));
  for (const char* cell : {"status", "seconds", "error"}) head.emplace_back(cell);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < results.size(); ++k) {
    auto& row = rows.emplace_back(std::vector<std::string>{std::to_string(k + 1)});
    for (std::size_t d = 0; d < plan.axes.size(); ++d)
      row.push_back(plan.axes[d].numeric ? fmt::format("{:.6g}", plan.points[k].numbers[d])
                                         : page::escaped(plan.points[k].values[d]));
    for (const auto& q : quantities) row.push_back(figure_text(q.values[k]));
    row.push_back(results[k].state.status);
    row.push_back(fmt::format("{:.1f}", results[k].seconds));
    row.push_back(page::escaped(results[k].state.message));
  }
  return page::table(head, rows);
}

std::string with_error(double value, double error) {
  return std::isfinite(value) ? fmt::format("{:.3f} ± {:.3f}", value, error) : "–";
}

/// What each quantity follows, for designs that tell.
std::string sensitivities_table(const StudyPlan& plan, const std::vector<Quantity>& quantities) {
  if (quantities.empty() || (!quantities[0].indices && quantities[0].rank_correlation.empty())) return "";
  const bool indices = quantities[0].indices.has_value();
  std::vector<std::string> head = {"quantity"};
  for (const auto& axis : plan.axes)
    for (const char* what : indices ? std::vector{"first order", "total"} : std::vector{""})
      head.push_back(page::escaped(fmt::format("{}{}{}", axis.key, *what ? ": " : "", what)));
  if (indices) head.emplace_back("rows");
  std::vector<std::vector<std::string>> rows;
  for (const auto& q : quantities) {
    auto& row = rows.emplace_back(std::vector<std::string>{page::escaped(q.path)});
    for (std::size_t d = 0; d < plan.axes.size(); ++d) {
      if (!indices) {
        row.push_back(figure_text(q.rank_correlation[d]));
        continue;
      }
      const auto& index = q.indices->of[d];
      row.push_back(with_error(index.first, index.first_error));
      row.push_back(with_error(index.total, index.total_error));
    }
    if (indices) row.push_back(std::to_string(q.indices->rows));
  }
  return page::table(head, rows,
                     indices ? "Sobol indices: share of the variance that a key accounts for alone, and with all that "
                               "it does together with others; ± one standard deviation over bootstrap samples"
                             : "Spearman's rank correlation of each quantity with each key: 1 where it always rises "
                               "with the key, -1 where it always falls, near 0 where it does not follow it");
}

bool varies(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return low != values.end() && *low < *high;
}

/// Empty where there is nothing to see.
std::string plot_of(const StudyPlan& plan, std::size_t axis, const Quantity& q) {
  drawing::Series series{.name = "", .x = {}, .y = {}, .line = false, .markers = true};
  for (std::size_t k = 0; k < q.values.size(); ++k) {
    if (!std::isfinite(q.values[k])) continue;
    series.x.push_back(plan.points[k].numbers[axis]);
    series.y.push_back(q.values[k]);
  }
  if (!varies(series.x)) return "";
  const auto& a = plan.axes[axis];
  return page::drawing(
      drawing::draw_plot({series}, {.title = q.path,
                                    .x_label = a.numeric ? a.label() : a.key + ", by place in its list",
                                    .y_label = q.path.substr(q.path.rfind('/') + 1),
                                    .log_x = a.log,
                                    .width = 480,
                                    .height = 320}));
}

std::string plots(const StudyPlan& plan, const std::vector<Quantity>& quantities) {
  std::string all;
  std::size_t count = 0, left = 0;
  for (const auto& q : quantities)
    for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
      if (count == most_plots) {
        ++left;
        continue;
      }
      const std::string plot = plot_of(plan, axis, q);
      all += plot;
      count += !plot.empty();
    }
  if (left > 0)
    all += fmt::format("<p>{} more are not drawn; choose fewer `quantities`. All values are in study.csv.</p>\n", left);
  return all;
}

}  // namespace

std::string design_text(const case_file::Design& design) { return std::visit(DesignText{}, design); }

std::string study_page(const StudyPlan& plan, const std::vector<Quantity>& quantities,
                       const std::vector<PointResult>& results) {
  const std::string& title = plan.study.title;
  return page::begin(fmt::format("Study{}{}", title.empty() ? "" : ": ", title)) +
         fmt::format(
             "<p>{} with other values of {} of its keys: {}. Points that failed or are yet to be done have no "
             "figures.</p>\n",
             page::escaped(plan.study.case_file.filename().string()), plan.axes.size(),
             design_text(plan.study.design)) +
         sensitivities_table(plan, quantities) + points_table(plan, quantities, results) + plots(plan, quantities) +
         page::end();
}

}  // namespace tunica::pipeline
