// What a fit says in words.
#pragma once

#include <string>
#include <vector>

#include "tunica/stages/fit/fit.hpp"

namespace tunica::stages {

/// What was repaired.
std::vector<std::string> remarks_on_data(const std::vector<fitting::Protocol>& protocols);

/// What the data say of one unknown; empty where it is identified and within its bounds.
std::string remark_on(const FittedModel& fitted, std::size_t unknown);

/// On unknowns, on the search, and on the law where the vessel works.
std::vector<std::string> remarks_on(const FittedModel& fitted, const case_file::InVivoStress& stress);

}  // namespace tunica::stages
