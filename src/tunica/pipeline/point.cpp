#include "tunica/pipeline/point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "tunica/base/error.hpp"
#include "tunica/case/face_patterns.hpp"
#include "tunica/config/json_text.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/parallel/shared_error.hpp"
#include "tunica/pipeline/figures.hpp"
#include "tunica/pipeline/record.hpp"
#include "tunica/pipeline/stage_documents.hpp"

namespace tunica::pipeline {

namespace {

namespace fs = std::filesystem;
using config::Document;

/// A state belongs to the case that it was written for.
std::string fingerprint(const PointCase& point) {
  files::Hash hash;
  hash.add(point.text.data(), point.text.size());
  return files::hex(hash.value());
}

}  // namespace

fs::path PointCase::folder_of_stage(const std::string& stage) const {
  const auto at = shared.find(stage);
  return at == shared.end() ? folder / stage : at->second;
}

bool lies_under(const std::string& path, const std::string& key) { return path == key || path.starts_with(key + "."); }

Document with_values(const Document& base, const std::vector<std::pair<std::string, std::string>>& values) {
  Document document = base;
  for (const auto& [key, value] : values) document.set(key, Document(value, "the value of " + key));
  for (const auto& stage : stages())
    if (*stage.output != 0) document.remove(stage.output);
  return document;
}

void add_to_title(Document& document, const std::string& more) {
  const std::string title = document.text("title");
  document.set("title", fmt::format("{}{}{}", title, title.empty() ? "" : ": ", more));
}

std::string what_matters(const Stage& stage, const std::vector<config::Setting>& settings) {
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

std::string text_of_point(const PointCase& point, Document document, const fs::path& from, const std::string& head) {
  config::move_paths(document, *description_of<case_file::Case>(), from, point.folder);
  document.set("output.directory", ".");
  for (const auto& stage : stages())
    if (const auto at = point.shared.find(stage.name); at != point.shared.end())
      document.set(stage.output, at->second.lexically_relative(point.folder).string());
  return fmt::format("# {}\n", head) + config::commented_yaml(document, *description_of<case_file::Case>());
}

void write_case(const PointCase& point) {
  files::make_folder(point.folder);
  if (!files::holds(point.file, point.text)) files::write_atomically(point.file, point.text);
}

CaseFiles::~CaseFiles() {
  if (keep_) return;
  std::error_code ignored;  // a look has no result that could be lost
  for (const auto& [file, text] : before_) {
    if (!text)
      fs::remove(file, ignored);
    else if (std::ofstream out(file, std::ios::binary); out)
      out << *text;
  }
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

void CaseFiles::make_folder(const fs::path& folder) {
  std::vector<fs::path> missing;
  for (auto at = folder; !at.empty() && !fs::exists(at); at = at.parent_path()) missing.push_back(at);
  made_.insert(made_.end(), missing.rbegin(), missing.rend());
  files::make_folder(folder);
}

void CaseFiles::write(const PointCase& point) {
  if (!keep_) {
    make_folder(point.folder);
    std::optional<std::string> text;
    if (fs::exists(point.file)) text = config::read_text(point.file);
    before_.emplace_back(point.file, std::move(text));
  }
  write_case(point);
}

PointState read_state(const PointCase& point) {
  const fs::path file = point.folder / "point.json";
  if (!fs::exists(file)) return {"pending", ""};
  const auto page = read_json(file);
  const auto text = [&](const char* key) -> std::string {
    const bool there = page.is_object() && page.contains(key) && page[key].is_string();
    return there ? page[key].get<std::string>() : "";
  };
  if (text("case") != fingerprint(point) || text("status").empty()) return {"pending", ""};
  return {text("status"), text("message")};
}

void write_state(const PointCase& point, const PointState& state) {
  const nlohmann::ordered_json page = {
      {"case", fingerprint(point)}, {"status", state.status}, {"message", state.message}};
  files::write_atomically(point.folder / "point.json", config::json_text(page));
}

fs::path post_json(const PointCase& point) { return point.folder / "post/post.json"; }

double seconds_of(const PointCase& point) {
  double seconds = 0;
  for (const auto& stage : stages())
    if (const auto record = read_record(point.folder_of_stage(stage.name))) seconds += record->seconds;
  return seconds;
}

PointEnd run_point(const ChainRequest& request, MPI_Comm comm, std::FILE* screen) {
  try {
    return {run_chain(request, comm, screen), ""};
  } catch (const InputError& e) {
    return {0, e.what()};
  } catch (const SolverError& e) {
    return {0, e.what()};
  } catch (const parallel::SharedError& e) {
    return {0, e.what()};
  }
}

PointState state_of(const PointEnd& end) {
  return {!end.error.empty() ? "failed" : end.signal != 0 ? "stopped" : "done", end.error};
}

}  // namespace tunica::pipeline
