#include "tunica/peer_cases/entry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/peer_cases/svsolver_files.hpp"

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

std::string ending(const fs::path& path) { return text::lower(path.extension().string()); }

bool has_ending(const fs::path& path) {
  const std::string own = ending(path);
  return own == ".xml" || own == ".inp" || own == ".svpre";
}

/// The input files in a folder, sorted; those with the usual names alone where there are any. The solver.inp beside a
/// .svpre is part of its simulation.
std::vector<fs::path> candidates(const fs::path& folder) {
  std::vector<fs::path> usual, others;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto& path = at->path();
    const std::string name = path.filename().string();
    if (name == "solver.xml" || name == "svFSI.inp" || ending(path) == ".svpre")
      usual.push_back(path);
    else if (has_ending(path) && !name.starts_with('.'))
      others.push_back(path);
  }
  if (!usual.empty()) others = usual;
  std::sort(others.begin(), others.end());
  return others;
}

bool is_project(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (ending(at->path()) == ".svproj") return true;
  return false;
}

/// The simulations in a SimVascular project, which keeps each in a folder of its own.
std::vector<fs::path> simulations(const fs::path& project) {
  constexpr int deepest = 4;
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::recursive_directory_iterator at(project, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end; at.increment(error)) {
    if (at.depth() >= deepest) at.disable_recursion_pending();
    const std::string name = at->path().filename().string();
    if (name == "solver.xml" || name == "svFSI.inp" || ending(name) == ".svpre") found.push_back(at->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<fs::path> inputs_of(const fs::path& folder) {
  auto found = candidates(folder);
  return found.empty() && is_project(folder) ? simulations(folder) : found;
}

fs::path file_in(const fs::path& folder) {
  const auto found = inputs_of(folder);
  if (found.empty() && is_project(folder))
    throw InputError(folder.string(),
                     "is a SimVascular project without a simulation: no .svpre, solver.xml or svFSI.inp",
                     "write the files of a simulation in SimVascular, whose mesh-complete they name");
  if (found.empty())
    throw InputError(folder.string(), "holds no solver.xml, no svFSI.inp and no .svpre",
                     "name the input file, or its folder");
  if (found.size() == 1) return found[0];
  std::vector<std::string> names;
  for (const auto& file : found) names.push_back(file.lexically_relative(folder).generic_string());
  throw InputError(folder.string(), fmt::format("holds {} input files: {}", found.size(), files::listed(names)),
                   "name the one that is meant");
}

}  // namespace

std::string Entry::where() const { return fmt::format("{}:{} {}", file, line, key); }

const Entry* Entry::peek(std::string_view wanted) const {
  for (const Entry& entry : entries)
    if (entry.key == wanted) return &entry;
  return nullptr;
}

const Entry* Entry::find(std::string_view wanted) const {
  const Entry* found = peek(wanted);
  if (found != nullptr) found->read = true;
  return found;
}

std::vector<const Entry*> Entry::all(std::string_view wanted) const {
  std::vector<const Entry*> found;
  for (const Entry& entry : entries)
    if (entry.key == wanted) {
      entry.read = true;
      found.push_back(&entry);
    }
  return found;
}

bool is_peer_file(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) ? inputs_of(path).size() == 1 : has_ending(path);
}

PeerFile read_peer_file(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? file_in(path) : path;
  if (!has_ending(file))
    throw InputError(
        file.string(), fmt::format("the extension '{}' does not tell the format", ending(file)),
        "name a solver.xml of svMultiPhysics, an .inp file of svFSI or the .svpre of an svSolver simulation");
  if (ending(file) == ".svpre") return read_svsolver(file);
  const std::string content = text::read(file);
  return ending(file) == ".xml" ? read_xml(content, file) : read_inp(content, file);
}

}  // namespace tunica::peer_cases
