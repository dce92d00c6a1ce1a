#include "tunica/wall/output.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::wall {

Vec3<double> principal_stresses(const Symmetric<double>& s) {
  const double mean = trace(s) / 3.0;
  Symmetric<double> deviator = s;
  for (int i = 0; i < 3; ++i) deviator[i] -= mean;
  const double size = std::sqrt(double_dot(deviator, deviator) / 6.0);
  if (!(size > 0.0)) return {{mean, mean, mean}};
  const double cosine = std::clamp(0.5 * determinant((1.0 / size) * deviator), -1.0, 1.0);
  const double angle = std::acos(cosine) / 3.0;
  const double largest = mean + 2.0 * size * std::cos(angle);
  const double smallest = mean + 2.0 * size * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
  return {{largest, 3.0 * mean - largest - smallest, smallest}};
}

}  // namespace tunica::wall
