#include "tunica/peer_cases/entry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

std::string ending(const fs::path& path) { return text::lower(path.extension().string()); }

bool has_ending(const fs::path& path) { return ending(path) == ".xml" || ending(path) == ".inp"; }

/// The input files in a folder, sorted; those with the usual names alone where there are any.
std::vector<fs::path> candidates(const fs::path& folder) {
  std::vector<fs::path> usual, others;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto& path = at->path();
    const std::string name = path.filename().string();
    if (name == "solver.xml" || name == "svFSI.inp")
      usual.push_back(path);
    else if (has_ending(path) && !name.starts_with('.'))
      others.push_back(path);
  }
  if (!usual.empty()) others = usual;
  std::sort(others.begin(), others.end());
  return others;
}

fs::path file_in(const fs::path& folder) {
  const auto found = candidates(folder);
  if (found.empty())
    throw InputError(folder.string(), "holds no solver.xml and no svFSI.inp", "name the input file, or its folder");
  if (found.size() == 1) return found[0];
  std::vector<std::string> names;
  for (const auto& file : found) names.push_back(file.filename().string());
  throw InputError(folder.string(), fmt::format("holds {} input files: {}", found.size(), files::listed(names)),
                   "name the one that is meant");
}

}  // namespace

std::string Entry::where() const { return fmt::format("{}:{} {}", file, line, key); }

const Entry* Entry::find(std::string_view wanted) const {
  for (const Entry& entry : entries)
    if (entry.key == wanted) return &entry;
  return nullptr;
}

std::vector<const Entry*> Entry::all(std::string_view wanted) const {
  std::vector<const Entry*> found;
  for (const Entry& entry : entries)
    if (entry.key == wanted) found.push_back(&entry);
  return found;
}

bool is_peer_file(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) ? candidates(path).size() == 1 : has_ending(path);
}

PeerFile read_peer_file(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? file_in(path) : path;
  if (!has_ending(file))
    throw InputError(file.string(), fmt::format("the extension '{}' does not tell the format", ending(file)),
                     "name a solver.xml of svMultiPhysics or an .inp file of svFSI");
  const std::string content = text::read(file);
  return ending(file) == ".xml" ? read_xml(content, file) : read_inp(content, file);
}

}  // namespace tunica::peer_cases
