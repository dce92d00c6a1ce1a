#include "tunica/pipeline/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/case/face_patterns.hpp"

namespace tunica::pipeline {

namespace fs = std::filesystem;

Outputs outputs_of(const fs::path& folder, const std::vector<std::string>& patterns) {
  Outputs found;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory() && fs::exists(entry->path() / "stage.json")) entry.disable_recursion_pending();
    if (!entry->is_regular_file()) continue;
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    const bool wanted = std::any_of(patterns.begin(), patterns.end(),
                                    [&](const auto& pattern) { return case_file::matches(pattern, name); });
    if (wanted) found[name] = entry->file_size();
  }
  return found;
}

std::vector<std::string> lost_outputs(const fs::path& folder, const Outputs& recorded) {
  std::vector<std::string> lost;
  for (const auto& [name, size] : recorded) {
    const fs::path file = folder / name;
    std::error_code none;
    const bool whole = fs::file_size(file, none) == size && !none &&
                       (file.extension() != ".checkpoint" || artifacts::damage_of(file).empty());
    if (!whole) lost.push_back(name);
  }
  return lost;
}

std::string text_of_lost(const std::vector<std::string>& lost) {
  if (lost.size() == 1) return lost.front() + " is missing or damaged";
  return fmt::format("{} and {} more are missing or damaged", lost.front(), lost.size() - 1);
}

}  // namespace tunica::pipeline
