#include "tunica/fitting/deviation.hpp"

#include <cmath>

namespace tunica::fitting {

Deviation deviation(const std::vector<double>& curve, const std::vector<double>& measured) {
  const double n = static_cast<double>(measured.size());
  double mean = 0.0, squares = 0.0, spread = 0.0;
  for (const double m : measured) mean += m / n;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    squares += (curve[i] - measured[i]) * (curve[i] - measured[i]);
    spread += (measured[i] - mean) * (measured[i] - mean);
  }
  Deviation d{std::sqrt(squares / n), {}};
  if (spread > 0.0) d.r_squared = 1.0 - squares / spread;
  return d;
}

}  // namespace tunica::fitting
