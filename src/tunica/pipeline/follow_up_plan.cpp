#include "tunica/pipeline/follow_up_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/config/document.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/pipeline/foresight.hpp"
#include "tunica/pipeline/plan.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Document;
using config::Setting;

/// What is wrong with the case of a scan stands beside the name of the scan.
void add(std::vector<Problem>& problems, const std::string& scan, const std::vector<Problem>& more) {
  for (const auto& p : more) problems.push_back({fmt::format("scans.{}: {}", scan, p.where), p.what, p.remedy});
}

/// The common case with the geometry of a scan, in the scan's folder.
std::string text_of(const FollowUpPlan& plan, const ScanCase& scan) {
  const fs::path common = absolute_path(*plan.settings.case_file);
  Document document = case_file::case_document(config::read_text(common), common);
  if (!document.has("mesh.geometry"))
    throw InputError("case",
                     fmt::format("{} has no section `mesh` whose geometry a scan could replace", common.string()),
                     "give scans by their own `case`, or name a case with `mesh`");
  config::move_paths(document, *description_of<case_file::Case>(), common.parent_path(), scan.file.parent_path());
  for (const auto& stage : stages())
    if (*stage.output != 0) document.remove(stage.output);
  document.remove("compare");
  const Document given(config::read_text(plan.file), plan.file.string());
  Document moved;
  moved.set("mesh.geometry", given.part(fmt::format("scans.{}.geometry", scan.name)));
  config::move_paths(moved, *description_of<case_file::Case>(), absolute_path(plan.file).parent_path(),
                     scan.file.parent_path());
  document.remove("mesh.geometry");
  document.set("mesh.geometry", moved.part("mesh.geometry"));
  const std::string title = document.text("title");
  document.set("title", fmt::format("{}{}{}, {}", title, title.empty() ? "" : ": ", scan.name, scan.date));
  document.set("output.directory", ".");
  return fmt::format("# {} of `tunica follow-up` {}\n", scan.name, plan.file.filename().string()) +
         config::commented_yaml(document, *description_of<case_file::Case>());
}

/// A case as far as its file tells.
struct ReadCase {
  case_file::Case settings;
  std::map<std::string, std::string> meshing;  ///< how it is meshed, by key
};

ReadCase read(const ScanCase& scan) {
  const Document document =
      case_file::case_document(scan.text.empty() ? config::read_text(scan.file) : scan.text, scan.file);
  std::vector<Setting> settings;
  ReadCase result;
  const config::Origin origin{.name = scan.file.string(), .folder = scan.file.parent_path()};
  result.settings = config::parse_document(case_file::Case::schema(), document, origin, &settings).value;
  for (const auto& s : settings) {
    const bool of_mesh = s.path.starts_with("mesh.") && !s.path.starts_with("mesh.geometry.");
    if (of_mesh && s.path != "mesh.title" && s.path != "mesh.output") result.meshing[s.path] = s.value;
  }
  return result;
}

std::vector<Problem> other_meshing(const ReadCase& first, const ReadCase& other, const std::string& name_of_first) {
  std::vector<Problem> problems;
  if (first.settings.mesh && !other.settings.mesh) return problems;  // a mesh that somebody made before
  std::set<std::string> keys;
  for (const auto& c : {first, other})
    for (const auto& [key, value] : c.meshing) keys.insert(key);
  const auto value = [](const ReadCase& c, const std::string& key) {
    const auto found = c.meshing.find(key);
    return found == c.meshing.end() ? std::string("not there") : found->second;
  };
  for (const auto& key : keys)
    if (first.settings.mesh && value(first, key) != value(other, key))
      problems.push_back({key, fmt::format("is {}, and {} in {}", value(other, key), value(first, key), name_of_first),
                          "mesh all scans by the same settings, or differences of meshes are taken for growth"});
  return problems;
}

std::vector<Problem> other_openings(const ReadCase& first, const ReadCase& other, const std::string& name_of_first) {
  const auto before = openings_to_come(first.settings), now = openings_to_come(other.settings);
  std::vector<Problem> problems;
  if (before.empty() || now.empty()) return problems;
  const std::string remedy = "give all scans the same openings with the same names; is it a scan of the same patient?";
  const auto miss = [&](const auto& in, const auto& names, const std::string& what) {
    for (const auto& name : in)
      if (std::find(names.begin(), names.end(), name) == names.end())
        problems.push_back({"mesh.geometry", fmt::format(fmt::runtime(what), name, name_of_first), remedy});
  };
  miss(before, now, "has no opening {}, which {} has");
  miss(now, before, "has the opening {}, which {} has not");
  return problems;
}

void check_case(const ReadCase& c, bool run, std::vector<Problem>& problems) {
  if (!c.settings.mesh && !c.settings.meshes.has_lumen())
    problems.push_back({"meshes", "has no lumen", "name the mesh of the blood as well: growth is that of its edge"});
  if (run && !c.settings.post)
    problems.push_back({"post", "is missing, and its figures are what growth is held beside", "add `post: {}`"});
}

}  // namespace

FollowUpPlan plan_follow_up(const fs::path& file, const std::optional<fs::path>& output, bool run) {
  FollowUpPlan plan{case_file::read_follow_up_case(file).value, file, {}, {}};
  plan.output = absolute_path(output.value_or(plan.settings.output));
  std::vector<Problem> problems;
  std::vector<ReadCase> cases;
  const int first_day = *case_file::day_of(plan.settings.scans.front().second.date);
  for (const auto& [name, scan] : plan.settings.scans) {
    const double years = (*case_file::day_of(scan.date) - first_day) / case_file::days_in_a_year;
    ScanCase one{name, scan.date, years,
                 scan.case_file ? absolute_path(*scan.case_file) : plan.output / name / "case.yaml"};
    try {
      if (scan.geometry) one.text = text_of(plan, one);
      cases.push_back(read(one));
      std::vector<Problem> found;
      check_case(cases.back(), run, found);
      if (!plan.scans.empty()) {
        for (const auto& part : {other_meshing(cases.front(), cases.back(), plan.scans.front().name),
                                 other_openings(cases.front(), cases.back(), plan.scans.front().name)})
          found.insert(found.end(), part.begin(), part.end());
      }
      add(problems, name, found);
    } catch (const InputError& error) {
      add(problems, name, error.problems());
    }
    plan.scans.push_back(std::move(one));
    if (cases.empty()) break;  // nothing to hold the others against
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return plan;
}

void write_and_check_cases(const FollowUpPlan& plan) {
  std::vector<Problem> problems;
  for (const auto& scan : plan.scans) {
    if (!scan.text.empty()) {
      files::make_folder(scan.file.parent_path());
      if (!files::holds(scan.file, scan.text)) files::write_atomically(scan.file, scan.text);
    }
    std::vector<Problem> warnings;
    try {
      read_chain(scan.file, std::nullopt, warnings);
    } catch (const InputError& error) {
      add(problems, scan.name, error.problems());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace tunica::pipeline
