// Units of reports and tables, in SI, for what does not depend on the units of a case; those of case files are in
// config/units.hpp.
#pragma once

#include <numbers>

namespace tunica::unit {

inline constexpr double mm = 1e-3, mm2 = 1e-6, ml = 1e-6;
inline constexpr double cm_s = 1e-2, ml_s = 1e-6;
inline constexpr double mmHg = 133.322387415, kPa = 1e3;
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace tunica::unit
