// Names of openings, faces, regions and tests, which become names of files, of columns of tables and keys of YAML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tunica/base/error.hpp"

namespace tunica::mesh {

/// What keeps a text from being such a name; empty when nothing does. A name has 1 to 100 bytes: letters of any
/// alphabet, digits, `_`, `-`, `.` and single blanks; it begins with a letter, a digit or `_`, and ends with one of
/// these.
std::string objection_to_name(std::string_view name);

/// A name and where it stands, for messages.
struct PlacedName {
  std::string name, where;
};

/// Names that break the rule, and names that differ in nothing but the case of ASCII letters, which would be one file
/// on some systems. `what` they name: "opening".
std::vector<Problem> check_names(const std::vector<PlacedName>& names, const std::string& what);

/// As check_names(), and none is called as the other faces of a mesh made with them: lumen_wall, wall_inner,
/// wall_outer.
std::vector<Problem> check_opening_names(const std::vector<PlacedName>& names);

}  // namespace tunica::mesh
