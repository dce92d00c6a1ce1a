#include "tunica/pipeline/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/document.hpp"
#include "tunica/pipeline/plan.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Document;
using config::Setting;

// --- problems -------------------------------------------------------------------------------------------------------

/// Problems of many points, each told once, with the first point that has it.
class PointProblems {
 public:
  explicit PointProblems(const StudyPlan& plan) : plan_(plan) {}

  void add(std::size_t point, const std::vector<Problem>& problems) {
    for (const auto& p : problems) {
      const bool fresh = seen_.emplace(p.where, p.what).second;
      if (fresh) all_.push_back({fmt::format("{}: {}", plan_.name_of(point), place(p.where)), p.what, p.remedy});
    }
  }
  void throw_if_any() {
    if (!all_.empty()) throw InputError(std::move(all_));
  }

 private:
  /// Values of varied keys stand in the file of the study, not in a line of the case.
  std::string place(const std::string& where) const {
    const std::string path = where.substr(0, where.find(" ("));
    for (const auto& axis : plan_.axes)
      if (lies_under(path, axis.key) || lies_under(axis.key, path))
        return fmt::format("{} ({}: vary.{})", path, plan_.file.string(), axis.key);
    return where;
  }

  const StudyPlan& plan_;
  std::set<std::pair<std::string, std::string>> seen_;
  std::vector<Problem> all_;
};

/// Numbers whose units differ cannot stand on one axis.
void check_units(const StudyPlan& plan, std::size_t axis, const std::vector<Setting>& settings,
                 std::vector<Problem>& problems) {
  const auto is_number = [&](const auto& point) { return case_file::number_and_unit(point.values[axis]).has_value(); };
  const std::string& key = plan.axes[axis].key;
  if (plan.axes[axis].numeric || !std::all_of(plan.points.begin(), plan.points.end(), is_number)) return;
  const bool quantity = std::any_of(settings.begin(), settings.end(), [&](const Setting& s) {
    return lies_under(s.path, key) && (s.kind == config::Kind::quantity || s.kind == config::Kind::unit);
  });
  if (quantity) problems.push_back({key, "has values in different units", "write all of them in one unit"});
}

// --- cases of the points --------------------------------------------------------------------------------------------

/// The case with the values of a point, its paths as they were.
Document varied(const Document& base, const StudyPlan& plan, std::size_t point) {
  std::vector<std::pair<std::string, std::string>> values;
  for (std::size_t k = 0; k < plan.axes.size(); ++k)
    values.emplace_back(plan.axes[k].key, plan.points[point].values[k]);
  Document document = with_values(base, values);
  document.remove("compare");
  add_to_title(document, fmt::format("point {}", point + 1));
  return document;
}

/// Gives the stages that several points have in common a folder, named by the first of them.
void share_stages(StudyPlan& plan, const std::vector<std::vector<Setting>>& settings,
                  const std::vector<case_file::Case>& cases) {
  for (const auto& stage : stages()) {
    if (!is_shareable(stage)) continue;
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < cases.size(); ++k)
      if (stage.wanted(cases[k])) groups[what_matters(stage, settings[k])].push_back(k);
    for (const auto& [text, members] : groups)
      for (const auto k : members)
        if (members.size() > 1)
          plan.cases[k].shared[stage.name] =
              plan.output / "shared" / fmt::format("{}_{:04}", stage.name, members.front() + 1);
  }
}

void make_cases(StudyPlan& plan) {
  const fs::path file = plan.study.case_file;
  const Document base = case_file::case_document(config::read_text(file), file);
  if (!base.has("post"))
    throw InputError(file.string(), "has no section `post`, and figures of the cycle are what a study looks at",
                     "add `post: {}` to the case");
  std::vector<Document> documents;
  std::vector<std::vector<Setting>> settings(plan.points.size());
  std::vector<case_file::Case> cases;
  PointProblems problems(plan);
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    const fs::path folder = plan.output / fmt::format("point_{:04}", k + 1);
    plan.cases.push_back({.folder = folder, .file = folder / "case.yaml", .text = ""});
    try {
      documents.push_back(varied(base, plan, k));
      const config::Origin origin{.name = file.string(), .folder = file.parent_path()};
      cases.push_back(config::parse_document(case_file::Case::schema(), documents.back(), origin, &settings[k]).value);
    } catch (const InputError& error) {
      problems.add(k, error.problems());
    }
  }
  problems.throw_if_any();
  std::vector<Problem> units;
  for (std::size_t k = 0; k < plan.axes.size(); ++k) check_units(plan, k, settings[0], units);
  problems.add(0, units);
  problems.throw_if_any();
  share_stages(plan, settings, cases);
  for (std::size_t k = 0; k < plan.points.size(); ++k)
    plan.cases[k].text = text_of_point(plan.cases[k], documents[k], file.parent_path(),
                                       fmt::format("Point {} of `tunica study` {}: {}", k + 1,
                                                   plan.file.filename().string(), plan.points[k].text(plan.axes)));
}

}  // namespace

std::string StudyPlan::name_of(std::size_t point) const {
  return fmt::format("point {} ({})", point + 1, points[point].text(axes));
}

StudyPlan plan_study(const fs::path& file, const std::optional<fs::path>& output) {
  StudyPlan plan;
  plan.study = case_file::read_study_case(file).value;
  plan.file = file;
  // Paths between folders are found by their names, which takes all of them from one place.
  plan.study.case_file = absolute_path(plan.study.case_file);
  plan.output = absolute_path(output.value_or(plan.study.output));
  auto made = case_file::study_points(plan.study);
  plan.axes = std::move(made.axes);
  plan.points = std::move(made.points);
  make_cases(plan);
  return plan;
}

void write_and_check_cases(const StudyPlan& plan, const std::vector<std::size_t>& points, CaseFiles& cases) {
  PointProblems problems(plan);
  for (const auto k : points) {
    const auto& c = plan.cases[k];
    cases.write(c);
    std::vector<Problem> warnings;
    try {
      read_chain(c.file, std::nullopt, warnings);
    } catch (const InputError& error) {
      problems.add(k, error.problems());
    }
  }
  problems.throw_if_any();
}

}  // namespace tunica::pipeline
