// The part of the page that holds results against measurements.
#pragma once

#include <string>

#include "tunica/stages/report/parts.hpp"

namespace tunica::stages::report {

/// The table of measurements beside what is computed, and a drawing of each; empty where nothing was measured.
std::string measured_part(const Results& r);

}  // namespace tunica::stages::report
