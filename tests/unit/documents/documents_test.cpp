// The documents keep step with the program: the case file of the README is valid, and equations that the code cites
// exist.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "folders.hpp"
#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"
#include "tunica/case/fibres_case.hpp"
#include "tunica/case/material_case.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
const fs::path root = TUNICA_SOURCE_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The first block of YAML in a page; empty when there is none.
std::string first_yaml(const std::string& page) {
  const std::string fence = "```yaml\n";
  const auto begin = page.find(fence);
  if (begin == std::string::npos) return {};
  const auto text = begin + fence.size();
  return page.substr(text, page.find("```", text) - text);
}

TEST(Documents, CaseFileOfTheReadmeIsValid) {
  const std::string yaml = first_yaml(read(root / "README.md"));
  try {
    const case_file::Case parsed = case_file::parse_case(yaml, root / "README.md");
    EXPECT_TRUE(parsed.solves_fluid() && parsed.solves_wall());
  } catch (const InputError& error) {
    FAIL() << error.what();
  }
}

TEST(Documents, MaterialFilesOfTheExamplesAreValid) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "examples"))
    if (entry.path().filename() == "material.yaml") {
      ++files;
      try {
        EXPECT_FALSE(case_file::read_material_case(entry.path()).value.tests.empty());
      } catch (const InputError& error) {
        ADD_FAILURE() << error.what();
      }
    }
  EXPECT_GT(files, 0);
}

TEST(Documents, FibresFilesAreValid) {
  const auto expect_valid = [](const std::string& yaml, const fs::path& file) {
    try {
      EXPECT_FALSE(case_file::parse_fibres_case(yaml, file).inlet.empty());
    } catch (const InputError& error) {
      ADD_FAILURE() << file << ": " << error.what();
    }
  };
  const fs::path example = root / "examples" / "dissection" / "fibres.yaml", page = root / "docs" / "fibres.md";
  expect_valid(read(example), example);
  expect_valid(first_yaml(read(page)), page);
}

TEST(Documents, CitedEquationsExist) {
  std::set<std::string> equations;
  const std::string theory = read(root / "docs" / "theory.md");
  const std::regex tag(R"(\\tag\{([0-9]+\.[0-9]+)\})");
  for (std::sregex_iterator i(theory.begin(), theory.end(), tag), end; i != end; ++i) {
    EXPECT_TRUE(equations.insert((*i)[1]).second) << "docs/theory.md has two equations " << (*i)[1];
  }
  ASSERT_FALSE(equations.empty());

  const std::regex comment("//.*"), citation(R"((?:[ ,]|eqs?\.? )\(([1-9][0-9]?\.[0-9]{1,2})\))");
  int cited = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "src")) {
    if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      std::smatch found;
      if (!std::regex_search(line, found, comment)) continue;
      const std::string text = found.str();
      for (std::sregex_iterator i(text.begin(), text.end(), citation), end; i != end; ++i) {
        ++cited;
        EXPECT_TRUE(equations.contains((*i)[1]))
            << entry.path() << ":" << number << ": docs/theory.md has no equation (" << (*i)[1] << ")";
      }
    }
  }
  EXPECT_GT(cited, 5);
}

}  // namespace
}  // namespace tunica
