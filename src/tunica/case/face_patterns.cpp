#include "tunica/case/face_patterns.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>

#include "tunica/mesh/boundary.hpp"

namespace tunica::case_file {

bool is_pattern(const std::string& name) { return name.find('*') != std::string::npos; }

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
}

std::vector<std::pair<std::string, bc::Condition>> without_patterns(
    const std::vector<std::pair<std::string, bc::Condition>>& conditions, const std::vector<std::string>& faces,
    std::vector<Problem>& problems) {
  std::vector<std::pair<std::string, bc::Condition>> result;
  std::map<std::string, std::string> taken;  // pattern by face
  const auto is_named = [&](const std::string& face) {
    return std::any_of(conditions.begin(), conditions.end(), [&](const auto& c) { return c.first == face; });
  };
  for (const auto& [name, condition] : conditions) {
    if (!is_pattern(name)) {
      result.emplace_back(name, condition);
      continue;
    }
    bool any = false;
    for (const auto& face : faces) {
      if (!matches(name, face)) continue;
      any = true;
      if (is_named(face)) continue;
      if (const auto [other, is_new] = taken.emplace(face, name); !is_new)
        problems.push_back({"boundary." + name, fmt::format("stands for {}, and so does {}", face, other->second),
                            fmt::format("name the face itself: `{}: ...`", face)});
      else
        result.emplace_back(face, condition);
    }
    if (!any)
      problems.push_back(
          {"boundary." + name, "stands for no face of the mesh", "its faces: " + mesh::list_names(faces)});
  }
  return result;
}

}  // namespace tunica::case_file
