#include "tunica/pipeline/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/config/document.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Document;
using config::Setting;

/// Is it the key, or one below it?
bool lies_under(const std::string& path, const std::string& key) { return path == key || path.starts_with(key + "."); }

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

/// The case with the values of a point, its paths as they were; every stage in its own place.
Document varied(const Document& base, const StudyPlan& plan, std::size_t point) {
  Document document = base;
  for (std::size_t k = 0; k < plan.axes.size(); ++k)
    document.set(plan.axes[k].key, Document(plan.points[point].values[k], "the value of " + plan.axes[k].key));
  for (const auto& stage : stages())
    if (*stage.output != 0) document.remove(stage.output);
  document.remove("compare");
  const std::string title = document.text("title");
  document.set("title", fmt::format("{}{}point {}", title, title.empty() ? "" : ": ", point + 1));
  return document;
}

/// All that can matter to a stage before `run`, as text: points with the same text share what it makes.
std::string what_matters(const Stage& stage, const std::vector<Setting>& settings) {
  const auto under_any = [](const std::string& path, std::initializer_list<const char*> sections) {
    return std::any_of(sections.begin(), sections.end(), [&](const char* s) { return lies_under(path, s); });
  };
  const bool mesh = stage.name == std::string("mesh"), fibres = stage.name == std::string("fibres");
  std::string text;
  for (const auto& s : settings) {
    if (mesh && !under_any(s.path, {"mesh"})) continue;
    if (fibres && !under_any(s.path, {"mesh", "meshes", "fibres"})) continue;
    if (under_any(s.path, {"title", "post", "report", "compare"})) continue;
    const bool of_no_matter = std::any_of(stage.without.begin(), stage.without.end(),
                                          [&](const auto& pattern) { return case_file::matches(pattern, s.path); });
    if (!of_no_matter) text += fmt::format("{}={}\n", s.path, s.value);
  }
  return text;
}

bool is_shareable(const Stage& stage) { return *stage.output != 0 && stage.name != std::string("post"); }

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

std::string text_of(const StudyPlan& plan, std::size_t point, Document document) {
  const auto& c = plan.cases[point];
  config::move_paths(document, *description_of<case_file::Case>(), plan.study.case_file.parent_path(), c.folder);
  document.set("output.directory", ".");
  for (const auto& stage : stages())
    if (const auto at = c.shared.find(stage.name); at != c.shared.end())
      document.set(stage.output, at->second.lexically_relative(c.folder).string());
  return fmt::format("# Point {} of `tunica study` {}: {}\n", point + 1, plan.file.filename().string(),
                     plan.points[point].text(plan.axes)) +
         config::commented_yaml(document, *description_of<case_file::Case>());
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
  for (std::size_t k = 0; k < plan.points.size(); ++k) plan.cases[k].text = text_of(plan, k, documents[k]);
}

}  // namespace

fs::path PointCase::folder_of_stage(const std::string& stage) const {
  const auto at = shared.find(stage);
  return at == shared.end() ? folder / stage : at->second;
}

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

void write_and_check_cases(const StudyPlan& plan, const std::vector<std::size_t>& points) {
  PointProblems problems(plan);
  for (const auto k : points) {
    const auto& c = plan.cases[k];
    files::make_folder(c.folder);
    if (!files::holds(c.file, c.text)) files::write_atomically(c.file, c.text);
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
