#include "tunica/artifacts/run_folder.hpp"

#include <fmt/format.h>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/field_io/series_index.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;

std::vector<std::string> missing_fields(const fs::path& folder, const std::vector<std::string>& regions, double until) {
  std::vector<std::string> missing;
  for (const auto& region : regions) {
    const fs::path series = field_io::series_file(folder, region);
    const auto entries = field_io::read_series(series);
    if (!fs::exists(series)) {
      missing.push_back(fmt::format("the series {} is missing", series.string()));
      continue;
    }
    std::vector<std::string> files;
    for (const auto& entry : entries)
      if (entry.time <= until) files.push_back(entry.file);
    if (!files.empty()) files.insert(files.begin(), field_io::mesh_file(region));
    for (const auto& file : files)
      if (!fs::exists(folder / file))
        missing.push_back(fmt::format("{} of the series {} is missing", file, series.string()));
  }
  return missing;
}

Continuation find_continuation(const fs::path& folder) {
  const SoundCheckpoint sound = last_sound_checkpoint(folder / "checkpoints");
  Continuation found{sound.file.has_value(), sound.passed_over};
  for (const char* history : {"steps.csv", "balance.csv"})
    if (found.possible && !fs::exists(folder / history)) {
      found.possible = false;
      found.warnings.push_back(fmt::format("{}: is missing", (folder / history).string()));
    }
  return found;
}

}  // namespace tunica::artifacts
