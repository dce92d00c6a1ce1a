// Numbers that stand for none.
#pragma once

#include <limits>

namespace tunica::base {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tunica::base
