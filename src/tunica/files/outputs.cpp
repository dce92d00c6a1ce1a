#include "tunica/files/outputs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <string_view>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"

namespace tunica::files {

namespace fs = std::filesystem;

namespace {

constexpr const char* another_folder = "name a folder that can be created and written";

/// The folder itself, or the lowest one above it that is there.
fs::path existing(fs::path folder) {
  std::error_code error;
  while (!folder.empty() && !fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder.empty() ? "." : folder;
}

/// Empty when all is well.
std::string name_problem(const fs::path& folder, const fs::path& file) {
  const fs::path there = existing(folder);
  const long of_folder = pathconf(there.c_str(), _PC_NAME_MAX);
  const std::size_t longest =
      (of_folder > 0 ? static_cast<std::size_t>(of_folder) : NAME_MAX) - std::string_view(temporary_ending).size();
  for (const auto& part : file)
    if (part.native().size() > longest)
      return fmt::format("the name has {} bytes, at most {} are possible there", part.native().size(), longest);
  std::error_code error;
  if (!fs::is_directory(there, error)) return fmt::format("{} is no folder", there.string());
  return {};
}

std::string problem_of(const fs::path& folder, const fs::path& file) {
  if (auto problem = name_problem(folder, file); !problem.empty()) return problem;
  const fs::path path = folder / file;
  std::error_code error;
  if (!fs::exists(path.parent_path().empty() ? "." : path.parent_path(), error))
    return name_problem(path.parent_path(), {});
  if (fs::exists(path, error) && !fs::is_regular_file(path, error) && !fs::is_directory(path, error)) return {};
  try {
    AtomicFile trial(path);
    trial.write("?", 1);
  } catch (const SolverError& failure) {
    return failure.what();
  }
  return {};
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw InputError(folder.string(), fmt::format("the folder cannot be made ({})", error.message()), another_folder);
}

void try_outputs(const fs::path& folder, const std::vector<fs::path>& files) {
  std::vector<Problem> problems;
  for (const auto& file : files)
    if (auto what = problem_of(folder, file); !what.empty())
      problems.push_back({(folder / file).string(), what, "choose another name or folder"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

void try_output(const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error))
    throw InputError(file.string(), fmt::format("cannot be written: {} is no folder", folder.string()),
                     "make the folder, or choose another name");
  try_outputs(folder, {file.filename()});
}

void refuse_other_than_file(const fs::path& file) {
  std::error_code ignored;  // what cannot be looked at is found to be so where it is opened
  const auto status = fs::status(file, ignored);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw InputError(file.string(),
                   fmt::format("is a {}, though tunica keeps a file of that name",
                               fs::is_directory(status) ? "folder" : "device, a pipe or a socket"),
                   "move it away, or choose another folder for the results");
}

bool fits(const std::string& pattern, const std::string& name) {
  const auto star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  const auto head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  return name.size() >= head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

void remove_outputs(const fs::path& folder, const std::vector<std::string>& patterns) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (entry.is_regular_file(error) &&
        std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) { return fits(pattern, name); }))
      old.push_back(entry.path());
  }
  for (const auto& file : old)
    if (!fs::remove(file, error))
      throw InputError(file.string(), fmt::format("cannot be removed: {}", error.message()), another_folder);
}

}  // namespace tunica::files
