#include "tunica/pipeline/identify_results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/identify_page.hpp"

namespace tunica::pipeline {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double telling = 1e4;    ///< upper over lower end of an interval that is worth its numbers
constexpr double alike = 0.95;     ///< correlation beyond which two parameters are not told apart
constexpr double on_bound = 1e-3;  ///< relative distance

// --- what a run has computed ----------------------------------------------------------------------------------------

HeldAgainst held_curve(const ChosenMeasurement& m, const PointCase& run) {
  const auto table = files::read_csv(run.folder / fmt::format("post/measured_{}.csv", m.name), "do the run anew");
  const auto column = [&](const char* what) { return table.column(fmt::format("{} [{}]", what, m.kind->unit)); };
  return {.times = table.column("time [s]"),
          .measured = column("measured"),
          .deviations = column("deviation"),
          .computed = column("computed")};
}

HeldAgainst held_values(const ChosenMeasurement& m, const json& list) {
  HeldAgainst held;
  for (const auto& entry : list) {
    if (entry.value("name", "") != m.name) continue;
    for (const auto& row : entry.at("rows")) {
      held.what.push_back(row.at("what"));
      held.measured.push_back(row.at("measured"));
      held.deviations.push_back(row.at("deviation"));
      held.computed.push_back(row.at("computed"));
    }
  }
  return held;
}

// --- in words -------------------------------------------------------------------------------------------------------

std::string value_text(const IdentifiedParameter& p, double value) {
  return fmt::format("{:.4g}{}{}", value, p.unit.empty() ? "" : " ", p.unit);
}

/// Do the residuals move by more than a deviation when the parameter goes from bound to bound, by the slopes at the
/// end?
bool matters(const IdentifyPlan& plan, const Identified& found, std::size_t k) {
  const std::size_t n = plan.parameters.size();
  double squares = 0;
  for (std::size_t row = k; row < found.slopes.size(); row += n) squares += found.slopes[row] * found.slopes[row];
  return std::sqrt(squares) * std::log(plan.parameters[k].high / plan.parameters[k].low) > 1;
}

void add_interval(const IdentifyPlan& plan, const Identified& found, std::size_t k, std::vector<std::string>& lines) {
  const auto& p = plan.parameters[k];
  const auto interval = *found.interval(k);
  if (!matters(plan, found, k))
    lines.push_back(fmt::format(
        "{} is not determined by these measurements: from one bound to the other it changes what is measured by less "
        "than its uncertainty",
        p.name));
  else if (interval.second / interval.first > p.high / p.low)
    lines.push_back(
        fmt::format("{} is not determined by these measurements: its interval, {}, is wider than its bounds, {} to {}",
                    p.name, found.interval_text(k), value_text(p, p.low), value_text(p, p.high)));
}

void add_bounds(const IdentifyPlan& plan, const Identified& found, std::vector<std::string>& lines) {
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    const auto& p = plan.parameters[k];
    const double value = found.values()[k];
    const bool low = value<p.low*(1 + on_bound), high = value> p.high * (1 - on_bound);
    if (low || high)
      lines.push_back(fmt::format("{} sits on its {} bound, {}{}", p.name, low ? "lower" : "upper",
                                  value_text(p, low ? p.low : p.high),
                                  matters(plan, found, k) ? ": the measurements ask for a value beyond it" : ""));
  }
}

// --- files ----------------------------------------------------------------------------------------------------------

std::string runs_csv(const IdentifyPlan& plan, const Identified& found) {
  std::string csv = "run,purpose";
  for (const auto& p : plan.parameters) csv += "," + csv_cell(p.label());
  csv += ",misfit [deviations],lowest,status,seconds,error\n";
  for (std::size_t k = 0; k < found.runs.size(); ++k) {
    const auto& run = found.runs[k];
    csv += fmt::format("{},{}", k + 1, csv_cell(purpose_of(plan, run)));
    for (const double value : run.values) csv += fmt::format(",{:.10g}", value);
    csv += fmt::format(",{:.8g},{},{},{:.1f},{}\n", run.misfit, run.lowest ? 1 : 0, run.state.status, run.seconds,
                       csv_cell(run.state.message));
  }
  return csv;
}

ordered_json parameter_json(const IdentifyPlan& plan, const Identified& found, std::size_t k) {
  const auto& p = plan.parameters[k];
  ordered_json page = {{"name", p.name},   {p.is_factor() ? "factor_on" : "keys", p.keys},
                       {"unit", p.unit},   {"between", {p.low, p.high}},
                       {"start", p.start}, {"value", found.values()[k]}};
  if (const auto interval = found.interval(k))
    page["interval_95"] = {finite_or_null(interval->first), finite_or_null(interval->second)};
  return page;
}

ordered_json run_json(const IdentifyPlan& plan, const Identified& found, std::size_t k) {
  const auto& run = found.runs[k];
  ordered_json page = {{"run", k + 1}, {"purpose", purpose_of(plan, run)}};
  for (std::size_t i = 0; i < run.values.size(); ++i) page["values"][plan.parameters[i].name] = run.values[i];
  page["misfit"] = finite_or_null(run.misfit);
  page["lowest"] = run.lowest;
  page["status"] = run.state.status;
  page["seconds"] = run.seconds;
  if (!run.state.message.empty()) page["error"] = run.state.message;
  return page;
}

ordered_json identified_json(const IdentifyPlan& plan, const Identified& found) {
  ordered_json page = {{"identify", plan.file.filename().string()},
                       {"case", plan.settings.case_file.filename().string()},
                       {"converged", found.converged},
                       {"ending", found.ending},
                       {"misfit", {{"start", found.runs.front().misfit}, {"end", found.runs[found.best].misfit}}},
                       {"independent_values", plan.independent()}};
  const std::size_t n = plan.parameters.size();
  for (std::size_t k = 0; k < n; ++k) page["parameters"].push_back(parameter_json(plan, found, k));
  if (found.estimates)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        page["correlation"][plan.parameters[i].name][plan.parameters[j].name] =
            finite_or_null(found.estimates->correlation[i][j]);
  page["undetermined"] = undetermined(plan, found);
  for (std::size_t k = 0; k < plan.measurements.size(); ++k)
    page["measurements"].push_back({{"name", plan.measurements[k].name},
                                    {"quantity", plan.measurements[k].kind->quantity},
                                    {"independent_values", plan.measurements[k].independent},
                                    {"misfit_start", found.first[k].misfit()},
                                    {"misfit_end", found.last[k].misfit()}});
  for (std::size_t k = 0; k < found.runs.size(); ++k) page["runs"].push_back(run_json(plan, found, k));
  return page;
}

}  // namespace

double HeldAgainst::misfit() const {
  double squares = 0;
  for (std::size_t k = 0; k < measured.size(); ++k)
    squares += std::pow((computed[k] - measured[k]) / deviations[k], 2) / static_cast<double>(measured.size());
  return std::sqrt(squares);
}

std::vector<HeldAgainst> read_held(const IdentifyPlan& plan, const PointCase& run) {
  const auto post = read_json(post_json(run));
  std::vector<HeldAgainst> all;
  for (const auto& m : plan.measurements) {
    try {
      all.push_back(m.curve ? held_curve(m, run) : held_values(m, post.at("measured")));
    } catch (const InputError& error) {
      throw SolverError(error.what());
    } catch (const json::exception& error) {
      throw SolverError(fmt::format("{} has no {}: {}", post_json(run).string(), m.path(), error.what()));
    }
    for (const double v : all.back().computed)
      if (!std::isfinite(v)) throw SolverError(fmt::format("{} is not finite", m.path()));
    if (all.back().computed.empty()) throw SolverError(fmt::format("{} has no {}", post_json(run).string(), m.path()));
  }
  return all;
}

std::vector<double> residuals_of(const IdentifyPlan& plan, const std::vector<HeldAgainst>& held) {
  std::vector<double> residuals;
  for (std::size_t m = 0; m < held.size(); ++m) {
    const auto& h = held[m];
    const double weight = std::sqrt(plan.measurements[m].independent / static_cast<double>(h.measured.size()));
    for (std::size_t k = 0; k < h.measured.size(); ++k)
      residuals.push_back(weight * (h.computed[k] - h.measured[k]) / h.deviations[k]);
  }
  return residuals;
}

std::optional<std::pair<double, double>> Identified::interval(std::size_t parameter) const {
  if (!estimates) return std::nullopt;
  const double factor = std::exp(estimates->quantile * estimates->deviations[parameter]);
  return std::pair{values()[parameter] / factor, values()[parameter] * factor};
}

std::string Identified::interval_text(std::size_t parameter) const {
  const auto ends = interval(parameter);
  if (!ends) return "–";
  if (!(ends->second < telling * ends->first)) return "any value";
  return fmt::format("{} to {}", figure_text(ends->first), figure_text(ends->second));
}

std::string purpose_of(const IdentifyPlan& plan, const IdentifyRun& run) {
  switch (run.query.purpose) {
    case fitting::Purpose::start:
      return "start";
    case fitting::Purpose::difference:
      return "difference of " + plan.parameters[run.query.unknown].name;
    case fitting::Purpose::step:
      break;
  }
  return "step";
}

std::vector<std::string> undetermined(const IdentifyPlan& plan, const Identified& found) {
  std::vector<std::string> lines;
  if (found.estimates)
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) add_interval(plan, found, k, lines);
  add_bounds(plan, found, lines);
  for (std::size_t k = 0; found.estimates && k < plan.parameters.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const double c = found.estimates->correlation[k][j];
      if (std::abs(c) > alike && matters(plan, found, k) && matters(plan, found, j))
        lines.push_back(fmt::format(
            "{} and {} are hardly told apart by these measurements (correlation {:.3f}): only one combination of them "
            "is determined",
            plan.parameters[j].name, plan.parameters[k].name, c));
    }
  return lines;
}

std::vector<std::string> write_identified(const IdentifyPlan& plan, const Identified& found) {
  files::write_atomically(plan.output / "identify.csv", runs_csv(plan, found));
  files::write_atomically(plan.output / "identify.json", config::json_text(identified_json(plan, found)));
  files::write_atomically(plan.output / "identify.html", identify_page(plan, found));
  files::write_atomically(plan.output / "identified.yaml", identified_text(plan, found.values()));
  std::vector<std::string> lines = {fmt::format("\n{}", found.ending)};
  for (std::size_t k = 0; k < plan.parameters.size(); ++k)
    lines.push_back(fmt::format("  {} = {} (95 %: {}), started at {}", plan.parameters[k].name,
                                value_text(plan.parameters[k], found.values()[k]), found.interval_text(k),
                                value_text(plan.parameters[k], plan.parameters[k].start)));
  lines.push_back(fmt::format("misfit: {} deviations at the start, {} in run {}, the best",
                              figure_text(found.runs.front().misfit), figure_text(found.runs[found.best].misfit),
                              found.best + 1));
  for (const auto& line : undetermined(plan, found)) lines.push_back("warning: " + line);
  lines.push_back(fmt::format("the case with these values: {}", (plan.output / "identified.yaml").string()));
  lines.push_back(fmt::format("identification: {}", (plan.output / "identify.html").string()));
  return lines;
}

}  // namespace tunica::pipeline
