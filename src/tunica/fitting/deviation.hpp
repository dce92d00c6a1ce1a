// How far a curve is from measured points.
#pragma once

#include <optional>
#include <vector>

namespace tunica::fitting {

struct Deviation {
  double rms = 0.0;                 ///< root of the mean square difference
  std::optional<double> r_squared;  ///< 1 - sum of squares / sum of squares about the mean; none for equal values
};
Deviation deviation(const std::vector<double>& curve, const std::vector<double>& measured);

}  // namespace tunica::fitting
