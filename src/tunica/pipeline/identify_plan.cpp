#include "tunica/pipeline/identify_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/study_case.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using case_file::IdentifiedKey;
using case_file::number_and_unit;
using config::Document;
using config::Setting;

std::string quantity_text(double number, const std::string& unit) {
  return fmt::format("{:.10g}{}{}", number, unit.empty() ? "" : " ", unit);
}

/// The case with values of all parameters, and what it settles.
struct ParsedCase {
  case_file::Case values;
  std::vector<Setting> settings;
};

ParsedCase parsed(const Document& document, const fs::path& file) {
  ParsedCase c;
  const config::Origin origin{.name = file.string(), .folder = file.parent_path()};
  c.values = config::parse_document(case_file::Case::schema(), document, origin, &c.settings).value;
  return c;
}

// --- parameters -----------------------------------------------------------------------------------------------------

/// A number of the file, which has to be in this unit.
std::optional<double> read_number(const std::string& where, const std::string& text, const std::string& unit,
                                  std::vector<Problem>& problems) {
  const auto number = number_and_unit(text);
  if (!number || !std::isfinite(number->first))
    problems.push_back({where, fmt::format("`{}` is no number", text), "write a number with its unit"});
  else if (number->second != unit)
    problems.push_back({where, fmt::format("`{}` is not in the unit of the others", text),
                        "write bounds and start in one unit, and those of a factor without"});
  else
    return number->first;
  return std::nullopt;
}

void read_bounds(const std::string& where, const IdentifiedKey& given, IdentifiedParameter& p,
                 std::vector<Problem>& problems) {
  if (const auto first = number_and_unit(given.between[0]); first && given.factor_on.empty()) p.unit = first->second;
  const auto low = read_number(where + ".between", given.between[0], p.unit, problems),
             high = read_number(where + ".between", given.between[1], p.unit, problems);
  if (!low || !high) return;
  p.low = *low, p.high = *high;
  if (!(p.low > 0))
    problems.push_back({where + ".between", fmt::format("`{}` is not above 0", given.between[0]),
                        "steps are relative: give positive bounds"});
  else if (!(p.high > p.low))
    problems.push_back({where + ".between", fmt::format("`{}` is not above `{}`", given.between[1], given.between[0]),
                        "give the smaller one first"});
}

/// The values that a factor multiplies, as the case has them.
void read_factored(const std::string& where, const Document& base, IdentifiedParameter& p,
                   std::vector<Problem>& problems) {
  for (const auto& key : p.keys) {
    p.factored.push_back(base.text(key));
    if (!number_and_unit(p.factored.back()))
      problems.push_back({where + ".factor_on", fmt::format("the case has no number at `{}`", key),
                          "write its value in the case, or find it by `keys`"});
  }
}

void read_start(const std::string& where, const IdentifiedKey& given, IdentifiedParameter& p,
                std::vector<Problem>& problems) {
  const auto start = read_number(where + ".start", given.start, p.unit, problems);
  if (start && !(*start > 0))
    problems.push_back({where + ".start", fmt::format("`{}` is not above 0", given.start), "give a value in bounds"});
  p.start = start.value_or(0);
}

std::vector<IdentifiedParameter> read_parameters(const case_file::IdentifyCase& c, const Document& base,
                                                 std::vector<Problem>& problems) {
  std::vector<IdentifiedParameter> all;
  std::map<std::string, std::string> owners;
  for (const auto& [name, given] : c.parameters) {
    const std::string where = "parameters." + name;
    IdentifiedParameter p{.name = name, .keys = given.keys.empty() ? given.factor_on : given.keys};
    for (auto& key : p.keys) {
      std::replace(key.begin(), key.end(), '/', '.');
      const auto section = key.substr(0, key.find_first_of(".["));
      for (const char* of_answer : {"measured", "post", "output", "report", "compare", "time", "newton", "linear"})
        if (section == of_answer)
          problems.push_back({where, fmt::format("has the key {}: `{}` is no property of the patient", key, of_answer),
                              "name keys of wall, tissue, blood or boundary"});
      if (const auto [at, fresh] = owners.emplace(key, name); !fresh)
        problems.push_back({where, fmt::format("has the key {}, as has {}", key, at->second), "name each key once"});
    }
    read_bounds(where, given, p, problems);
    if (!given.factor_on.empty()) {
      read_factored(where, base, p, problems);
      p.start = 1;
    }
    if (!given.start.empty()) read_start(where, given, p, problems);
    all.push_back(std::move(p));
  }
  return all;
}

Document with_parameters(const Document& base, const std::vector<IdentifiedParameter>& parameters,
                         const std::vector<double>& values) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    for (auto& setting : parameters[k].settings(values[k])) settings.push_back(std::move(setting));
  return with_values(base, settings);
}

/// Problems of the case with other values are told with the parameter that they belong to.
Problem placed(Problem p, const IdentifyPlan& plan, const std::vector<double>& values) {
  const std::string path = p.where.substr(0, p.where.find(" ("));
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const auto& key : plan.parameters[k].keys)
      if (lies_under(path, key) || lies_under(key, path))
        p.where =
            fmt::format("parameters.{} = {}: {}", plan.parameters[k].name, plan.parameters[k].shown(values[k]), path);
  return p;
}

ParsedCase parsed_with(const IdentifyPlan& plan, const std::vector<double>& values) {
  try {
    return parsed(with_parameters(plan.base, plan.parameters, values), plan.settings.case_file);
  } catch (const InputError& error) {
    std::vector<Problem> problems;
    for (const auto& p : error.problems()) problems.push_back(placed(p, plan, values));
    throw InputError(std::move(problems));
  }
}

/// The number that a key settles: what differs between the cases at both ends of the bounds. Empty: it is none.
std::string path_of_number(const std::string& key, const std::vector<Setting>& low, const std::vector<Setting>& high) {
  std::map<std::string, std::string> at_high;
  for (const auto& s : high) at_high[s.path] = s.value;
  std::string found;
  for (const auto& s : low) {
    if (!lies_under(s.path, key) || s.kind != config::Kind::quantity || at_high[s.path] == s.value) continue;
    if (!found.empty()) return {};
    found = s.path;
  }
  return found;
}

std::optional<double> number_at(const std::string& path, const std::vector<Setting>& settings) {
  for (const auto& s : settings)
    if (s.path == path) return number_and_unit(s.value)->first;
  return std::nullopt;
}

/// The start of a parameter that the file gives none for: what the case has, in the unit of the bounds.
void start_at_case(IdentifiedParameter& p, const std::vector<Setting>& base, const ParsedCase& low,
                   const ParsedCase& high, std::vector<Problem>& problems) {
  const std::string where = "parameters." + p.name;
  std::vector<double> starts;
  for (const auto& key : p.keys) {
    const std::string path = path_of_number(key, low.settings, high.settings);
    if (path.empty()) {
      problems.push_back({where, fmt::format("the key {} is no single number with a unit", key),
                          "name the key of a number, such as wall.material.neo_hooke.young_modulus"});
      return;
    }
    if (p.start > 0) continue;
    const auto in_case = number_at(path, base);
    if (!in_case)
      problems.push_back({where, fmt::format("the case has no value at {} to start from", key), "give `start`"});
    else
      starts.push_back(*in_case / *number_at(path, low.settings) * p.low);
  }
  if (p.start > 0 || starts.size() < p.keys.size()) return;
  const auto [least, most] = std::minmax_element(starts.begin(), starts.end());
  if (*most > *least * (1 + 1e-9))
    problems.push_back(
        {where, "has keys whose values in the case differ", "give `start`, or find a factor on them by `factor_on`"});
  p.start = number_and_unit(quantity_text(starts.front(), ""))->first;
}

void check_starts(const std::vector<IdentifiedParameter>& parameters, std::vector<Problem>& problems) {
  for (const auto& p : parameters)
    if (p.start < p.low || p.start > p.high)
      problems.push_back(
          {fmt::format("parameters.{}.start", p.name),
           fmt::format("is {}, not between {} and {}", p.shown(p.start), p.shown(p.low), p.shown(p.high)),
           "give another start, or wider bounds"});
}

std::vector<double> ends_of(const IdentifyPlan& plan, double IdentifiedParameter::*end) {
  std::vector<double> values;
  for (const auto& p : plan.parameters) values.push_back(p.*end);
  return values;
}

// --- measurements ---------------------------------------------------------------------------------------------------

ChosenMeasurement chosen(const case_file::MeasurementKind& kind, const std::string& name,
                         const case_file::Measurement& m, int most) {
  ChosenMeasurement c{.kind = &kind, .name = name, .curve = m.curve.has_value()};
  c.independent = m.largest.has_value() + m.smallest.has_value() + m.mean.has_value();
  if (m.curve)
    c.independent = std::min(static_cast<double>(most), static_cast<double>(case_file::read_course(m).times.size()));
  return c;
}

void choose_measurements(IdentifyPlan& plan, const case_file::MeasuredCase& measured) {
  const auto& patterns = plan.settings.measurements;
  std::vector<std::string> paths;
  for (const auto& kind : case_file::measurement_kinds())
    for (const auto& [name, m] : measured.*kind.entries) {
      const auto c = chosen(kind, name, m, plan.settings.independent_values);
      paths.push_back(c.path());
      if (patterns.empty() || fits_any(patterns, c.path())) plan.measurements.push_back(c);
    }
  std::vector<Problem> problems;
  for (const auto& pattern : patterns)
    if (std::none_of(paths.begin(), paths.end(), [&](const auto& path) { return fits_any({pattern}, path); }))
      problems.push_back({"measurements", fmt::format("`{}` fits none", pattern),
                          "the case has: " + (paths.empty() ? "none" : files::listed(paths))});
  if (paths.empty())
    problems.push_back({plan.settings.case_file.string() + ": measured", "holds no measurement", "docs/measured.md"});
  if (problems.empty() && plan.independent() < static_cast<double>(plan.parameters.size()))
    problems.push_back({"parameters",
                        fmt::format("are {}, more than the {} measured values that they are found from",
                                    plan.parameters.size(), plan.independent()),
                        "find fewer of them, or give more measurements"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

// --- stages ---------------------------------------------------------------------------------------------------------

/// A stage that is the same at both ends of the bounds and at the start is so in every run.
void share_stages_of_runs(IdentifyPlan& plan, const ParsedCase& low, const ParsedCase& high) {
  const auto start = parsed_with(plan, ends_of(plan, &IdentifiedParameter::start));
  for (const auto& stage : stages()) {
    if (!is_shareable(stage) || !stage.wanted(start.values)) continue;
    const auto text = what_matters(stage, start.settings);
    if (what_matters(stage, low.settings) == text && what_matters(stage, high.settings) == text)
      plan.shared[stage.name] = plan.output / "shared" / stage.name;
  }
}

case_file::Case checked_base(const IdentifyPlan& plan, std::vector<Setting>& settings) {
  auto base = parsed(plan.base, plan.settings.case_file);
  std::vector<Problem> problems;
  if (!base.values.measured)
    problems.push_back({plan.settings.case_file.string(), "has no section `measured` that values could be found from",
                        "add it; docs/measured.md"});
  if (!base.values.post)
    problems.push_back({plan.settings.case_file.string(),
                        "has no section `post`, which holds what is computed against the measurements",
                        "add `post: {}` to the case"});
  if (!problems.empty()) throw InputError(std::move(problems));
  settings = std::move(base.settings);
  return std::move(base.values);
}

}  // namespace

std::string IdentifiedParameter::text(double value) const { return quantity_text(value, unit); }

std::string IdentifiedParameter::shown(double value) const {
  return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string IdentifiedParameter::label() const { return unit.empty() ? name : fmt::format("{} [{}]", name, unit); }

std::vector<std::pair<std::string, std::string>> IdentifiedParameter::settings(double value) const {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (!is_factor()) {
      all.emplace_back(keys[k], text(value));
      continue;
    }
    const auto [number, own_unit] = *number_and_unit(factored[k]);
    all.emplace_back(keys[k], quantity_text(number * value, own_unit));
  }
  return all;
}

std::string ChosenMeasurement::path() const { return fmt::format("{}/{}", kind->key, name); }

double IdentifyPlan::independent() const {
  double sum = 0;
  for (const auto& m : measurements) sum += m.independent;
  return sum;
}

std::string IdentifyPlan::text(const std::vector<double>& values) const {
  std::string all;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    all += fmt::format("{}{} = {}", k == 0 ? "" : ", ", parameters[k].name, parameters[k].shown(values[k]));
  return all;
}

IdentifyPlan plan_identify(const fs::path& file, const std::optional<fs::path>& output) {
  IdentifyPlan plan{.settings = case_file::read_identify_case(file).value, .file = file};
  plan.settings.case_file = absolute_path(plan.settings.case_file);
  plan.output = absolute_path(output.value_or(plan.settings.output));
  plan.base = case_file::case_document(config::read_text(plan.settings.case_file), plan.settings.case_file);
  std::vector<Setting> settings;
  const auto base = checked_base(plan, settings);
  std::vector<Problem> problems;
  plan.parameters = read_parameters(plan.settings, plan.base, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  const auto low = parsed_with(plan, ends_of(plan, &IdentifiedParameter::low)),
             high = parsed_with(plan, ends_of(plan, &IdentifiedParameter::high));
  for (auto& p : plan.parameters) start_at_case(p, settings, low, high, problems);
  if (problems.empty()) check_starts(plan.parameters, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  choose_measurements(plan, *base.measured);
  share_stages_of_runs(plan, low, high);
  return plan;
}

PointCase case_of_run(const IdentifyPlan& plan, std::size_t run, const std::vector<double>& values) {
  const fs::path folder = plan.output / fmt::format("run_{:04}", run);
  PointCase point{.folder = folder, .file = folder / "case.yaml", .text = "", .shared = plan.shared};
  Document document = with_parameters(plan.base, plan.parameters, values);
  for (const char* section : {"compare", "report"}) document.remove(section);  // for the case that is found
  add_to_title(document, fmt::format("run {}", run));
  point.text = text_of_point(
      point, std::move(document), plan.settings.case_file.parent_path(),
      fmt::format("Run {} of `tunica identify` {}: {}", run, plan.file.filename().string(), plan.text(values)));
  return point;
}

std::string identified_text(const IdentifyPlan& plan, const std::vector<double>& values) {
  Document document = with_parameters(plan.base, plan.parameters, values);
  config::move_paths(document, *description_of<case_file::Case>(), plan.settings.case_file.parent_path(), plan.output);
  document.set("output.directory", "identified");
  return fmt::format("# {} with the values that `tunica identify` {} has found: {}\n",
                     plan.settings.case_file.filename().string(), plan.file.filename().string(), plan.text(values)) +
         config::commented_yaml(document, *description_of<case_file::Case>());
}

}  // namespace tunica::pipeline
