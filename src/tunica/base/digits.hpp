// Numbers for readers.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tunica::base {

/// The number of at most 12 digits nearest to `number`: sums and products of steps leave 0.27040000000000003 where
/// 0.2704 is meant. For times in files.
inline double without_noise(double number) {
  if (!std::isfinite(number)) return number;
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", number);
  return std::strtod(text, nullptr);
}

}  // namespace tunica::base
