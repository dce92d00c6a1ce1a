// Holds the includes of a source tree against the two tables of ARCHITECTURE.md: which folder may include which, and
// which folders may use MPI, PETSc, VTK and CGAL; no stage may include another. Prints every breach; also warns about
// overlong files.
//
// Usage: check_includes ARCHITECTURE.md ROOT, where ROOT holds src/tunica, app and python.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

constexpr int longest_file = 500;

struct Library {
  std::string name;
  Names prefixes;  ///< how its headers begin
  Names folders;
  bool sources_only;  ///< allowed in .cpp files, not in headers
};

struct Rules {
  std::map<std::string, Names> folders;
  std::vector<Library> libraries;
};

std::string trim(const std::string& text) {
  const auto first = text.find_first_not_of(" `\t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" `\t\r") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(trim(part));
  return parts;
}

Names names_in(const std::string& cell) {
  Names names;
  for (const auto& name : split(cell, ',')) {
    if (!name.empty() && name != "–") names.insert(name);
  }
  return names;
}

/// Rows of the table whose first heading is `heading`, as cells without the outer bars.
std::vector<std::vector<std::string>> read_table(const fs::path& document, const std::string& heading) {
  std::ifstream file(document);
  if (!file) throw std::runtime_error("cannot read " + document.string());
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| " + heading + " |", 0) == 0) {
      inside = true;
    } else if (inside && line.rfind('|', 0) != 0) {
      break;
    } else if (inside && line.rfind("|-", 0) != 0) {
      auto cells = split(line, '|');
      cells.erase(cells.begin());
      rows.push_back(std::move(cells));
    }
  }
  if (rows.empty()) throw std::runtime_error(document.string() + " has no table headed '" + heading + "'");
  return rows;
}

Rules read_rules(const fs::path& document) {
  Rules rules;
  for (const auto& row : read_table(document, "folder")) {
    if (row.size() < 2) throw std::runtime_error("a row of the folder table has fewer than two cells");
    const Names allowed = names_in(row[1]);
    for (const auto& folder : names_in(row[0])) {
      rules.folders[folder] = allowed;
      rules.folders[folder].insert(folder);
    }
  }
  for (const auto& row : read_table(document, "library")) {
    if (row.size() < 4) throw std::runtime_error("a row of the library table has fewer than four cells");
    rules.libraries.push_back({row[0], names_in(row[1]), names_in(row[2]), row[3] == ".cpp only"});
  }
  return rules;
}

class Checker {
 public:
  Checker(const Rules& rules, fs::path root) : rules_(rules), root_(std::move(root)) {}

  void check_file(const fs::path& path, const std::string& folder) {
    const std::string shown = fs::relative(path, root_).string();
    ++files_;
    if (!rules_.folders.contains(folder)) {
      report(shown + ": the folder " + folder + " is not in the table");
      return;
    }
    static const std::regex include(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    std::ifstream file(path);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string where = shown + ":" + std::to_string(number) + ": ";
      check_include(where, path, folder, match[2], match[1] == "\"");
    }
    if (number > longest_file) {
      std::cout << "warning: " << shown << " has " << number << " lines; aim at fewer than " << longest_file << '\n';
    }
  }

  int files() const { return files_; }
  int breaches() const { return breaches_; }

 private:
  void check_include(const std::string& where, const fs::path& path, const std::string& folder,
                     const std::string& header, bool quoted) {
    const auto parts = split(header, '/');
    if (parts.front() == "tunica" && parts.size() >= 3) {
      if (!rules_.folders.at(folder).contains(parts[1])) report(where + folder + " may not include " + parts[1]);
      check_stages(where, path, folder, parts);
      return;
    }
    for (const auto& library : rules_.libraries) {
      if (std::none_of(library.prefixes.begin(), library.prefixes.end(),
                       [&](const std::string& prefix) { return header.rfind(prefix, 0) == 0; }))
        continue;
      const std::string what = where + library.name + " (" + header + ") is ";
      if (!library.folders.contains(folder)) {
        report(what + "not allowed in " + folder);
      } else if (library.sources_only && path.extension() != ".cpp") {
        report(what + "allowed in .cpp files only");
      }
      return;
    }
    // The files of app/ and python/ are no library: they include each other by file name.
    if (quoted && folder != "app" && folder != "python")
      report(where + "write \"tunica/<folder>/<file>\" instead of \"" + header + '"');
  }

  /// stages/a/ may include stages/a/ and the files in stages/ itself, these none of the stages.
  void check_stages(const std::string& where, const fs::path& path, const std::string& folder,
                    const std::vector<std::string>& parts) {
    if (folder != "stages" || parts[1] != "stages" || parts.size() == 3) return;
    const std::string stage = path.parent_path().filename().string();
    if (stage != parts[2]) report(where + "the stage " + parts[2] + " is not for others to include");
  }

  void report(const std::string& message) {
    std::cout << message << '\n';
    ++breaches_;
  }

  const Rules& rules_;
  fs::path root_;
  int files_ = 0;
  int breaches_ = 0;
};

/// C++ files below `directory`, sorted so that reports are the same everywhere.
std::vector<fs::path> cpp_files(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    const auto extension = entry.path().extension();
    if (extension == ".hpp" || extension == ".cpp" || extension == ".ipp" || extension == ".inc") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

int run(const fs::path& document, const fs::path& root) {
  const Rules rules = read_rules(document);
  Checker checker(rules, root);
  const fs::path sources = root / "src" / "tunica";
  for (const auto& path : cpp_files(sources)) {
    const fs::path below = fs::relative(path, sources);
    checker.check_file(path, below.begin()->string());
  }
  for (const char* folder : {"app", "python"})
    if (fs::exists(root / folder))
      for (const auto& path : cpp_files(root / folder)) checker.check_file(path, folder);
  if (checker.files() == 0) throw std::runtime_error("no C++ file below " + sources.string());
  std::cout << checker.files() << " files, " << checker.breaches() << " breaches of the include rule\n";
  return checker.breaches() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: check_includes ARCHITECTURE.md ROOT\n";
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "check_includes: " << error.what() << '\n';
    return 2;
  }
}
