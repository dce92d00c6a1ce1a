#include "tunica/artifacts/run_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "tunica/artifacts/checkpoint.hpp"
#include "tunica/files/series_file.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;

namespace {

/// What a .pvtu file names.
std::vector<std::string> pieces_of(const fs::path& file) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}}, key = "Source=\"";
  std::vector<std::string> pieces;
  for (auto at = text.find(key); at != std::string::npos; at = text.find(key, at)) {
    at += key.size();
    pieces.push_back(text.substr(at, text.find('"', at) - at));
  }
  return pieces;
}

}  // namespace

std::vector<std::string> missing_fields(const fs::path& folder, const std::vector<std::string>& regions, double until) {
  std::vector<std::string> missing;
  for (const auto& region : regions) {
    const fs::path series = folder / (region + ".pvd");
    if (!fs::exists(series)) {
      missing.push_back(fmt::format("the series {} is missing", series.string()));
      continue;
    }
    const auto look_for = [&](const std::string& name) {
      const bool there = fs::exists(folder / name);
      if (!there) missing.push_back(fmt::format("{} of the series {} is missing", name, series.string()));
      return there;
    };
    for (const auto& entry : files::read_pvd(series))
      if (entry.time <= until && look_for(entry.file))
        for (const auto& piece : pieces_of(folder / entry.file)) look_for(piece);
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
