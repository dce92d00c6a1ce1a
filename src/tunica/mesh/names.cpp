#include "tunica/mesh/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tunica/base/text.hpp"

namespace tunica::mesh {

namespace {

constexpr std::size_t longest_name = 100;
/// Of the lumen and of the wall, beside `lumen_<opening>` and `wall_<opening>`.
constexpr std::array<std::string_view, 3> names_taken = {"wall", "inner", "outer"};

bool is_outside_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }
bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || is_outside_ascii(c);
}

/// Blanks and marks outside ASCII that cannot be seen: C1 controls, no-break and other blanks, marks of order and
/// direction.
bool has_invisible(std::string_view name) {
  for (std::size_t i = 0; i + 1 < name.size(); ++i) {
    const auto a = static_cast<unsigned char>(name[i]), b = static_cast<unsigned char>(name[i + 1]);
    if (a == 0xC2 && (b < 0xA1 || b == 0xAD)) return true;
    if (a == 0xE2 && (b == 0x80 || b == 0x81)) return true;  // U+2000 .. U+207F
    if (a == 0xE3 && b == 0x80 && i + 2 < name.size() && static_cast<unsigned char>(name[i + 2]) == 0x80) return true;
    if (a == 0xEF && b == 0xBB) return true;
  }
  return false;
}

Problem problem_of(const PlacedName& named, const std::string& what, const std::string& objection) {
  return {text::printable(named.where, 400),
          fmt::format("the name '{}' of {} {} {}", text::printable(named.name, 100),
                      what.find_first_of("aeio") == 0 ? "an" : "a", what, objection),
          "use letters, digits, `_`, `-`, `.` and single blanks: it becomes the name of a file"};
}

}  // namespace

std::string objection_to_name(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > longest_name) return fmt::format("has {} bytes, {} are allowed", name.size(), longest_name);
  if (text::valid_utf8(name) < name.size()) return "is not UTF-8";
  if (has_invisible(name)) return "has a blank or mark that cannot be seen";
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (is_letter_or_digit(c) || c == '-' || c == '.' || c == ' ') continue;
    return fmt::format("has the character '{}'", text::printable(name.substr(i, 1)));
  }
  if (!is_letter_or_digit(name.front())) return fmt::format("begins with '{}'", name.front());
  if (!is_letter_or_digit(name.back())) return fmt::format("ends with '{}'", name.back());
  if (name.find("  ") != std::string_view::npos) return "has several blanks in a row";
  if (name.find("..") != std::string_view::npos) return "has several points in a row";
  return {};
}

std::vector<Problem> check_names(const std::vector<PlacedName>& names, const std::string& what) {
  std::vector<Problem> problems;
  std::map<std::string, const PlacedName*> known;
  for (const auto& named : names) {
    if (const auto objection = objection_to_name(named.name); !objection.empty()) {
      problems.push_back(problem_of(named, what, objection));
      continue;
    }
    const auto [same, is_new] = known.emplace(text::lower(named.name), &named);
    if (is_new) continue;
    problems.push_back({text::printable(named.where, 400),
                        same->second->name == named.name
                            ? fmt::format("the name '{}' is there already, at {}", named.name, same->second->where)
                            : fmt::format("the name '{}' differs from '{}' at {} in the case of letters only",
                                          named.name, same->second->name, same->second->where),
                        fmt::format("give each {} a name of its own", what)});
  }
  return problems;
}

std::vector<Problem> check_opening_names(const std::vector<PlacedName>& names) {
  std::vector<Problem> problems = check_names(names, "opening");
  for (const auto& named : names)
    if (std::find(names_taken.begin(), names_taken.end(), text::lower(named.name)) != names_taken.end())
      problems.push_back({text::printable(named.where, 400),
                          fmt::format("an opening cannot be called '{}': the mesh has the faces lumen_wall, wall_inner "
                                      "and wall_outer besides",
                                      named.name),
                          "give it another name"});
  return problems;
}

}  // namespace tunica::mesh
