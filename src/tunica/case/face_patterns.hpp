// One condition for many faces.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/bc/conditions.hpp"

namespace tunica::case_file {

/// Does a name hold a `*`, which stands for any letters?
bool is_pattern(const std::string& name);
bool matches(const std::string& pattern, const std::string& name);

/// The conditions with every pattern replaced by the faces that match it and are not named themselves. Adds to
/// `problems`: a pattern that no face matches, a face that two patterns match.
std::vector<std::pair<std::string, bc::Condition>> without_patterns(
    const std::vector<std::pair<std::string, bc::Condition>>& conditions, const std::vector<std::string>& faces,
    std::vector<Problem>& problems);

}  // namespace tunica::case_file
