#include "tunica/analysis/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tunica::analysis {

std::vector<double> trapezoid_weights(std::span<const double> times) {
  std::vector<double> weights(times.size(), 0.0);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double half = 0.5 * (times[k] - times[k - 1]);
    weights[k - 1] += half;
    weights[k] += half;
  }
  return weights;
}

Derivative derivative_at(std::span<const double> times, std::size_t k) {
  const std::size_t first = std::min(k == 0 ? 0 : k - 1, times.size() - 3);
  Derivative d{first, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    // Derivative of the Lagrange polynomial of point i.
    const double a = times[first + (i + 1) % 3], b = times[first + (i + 2) % 3], own = times[first + i];
    d.weights[i] = (2 * times[k] - a - b) / ((own - a) * (own - b));
  }
  return d;
}

Course course(std::span<const double> times, std::span<const double> values) {
  Course c;
  if (times.empty()) return c;
  const auto weights = trapezoid_weights(times);
  double total = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    total += weights[k];
    c.mean += weights[k] * values[k];
    c.forward += weights[k] * std::max(values[k], 0.0);
    c.backward += weights[k] * std::max(-values[k], 0.0);
  }
  c.mean /= total;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  c.smallest = *low;
  c.largest = *high;
  c.time_of_smallest = times[static_cast<std::size_t>(low - values.begin())];
  c.time_of_largest = times[static_cast<std::size_t>(high - values.begin())];
  return c;
}

ShearFigures shear_figures(double magnitude_integral, const Vec3<double>& vector_integral, double duration) {
  if (!(magnitude_integral > 0)) return {0, 0, std::numeric_limits<double>::infinity()};
  const double resultant = norm(vector_integral);
  // Rounding may put the resultant of a steady stress above the sum of its magnitudes.
  return {magnitude_integral / duration, std::max(0.0, 0.5 * (1 - resultant / magnitude_integral)),
          duration / resultant};
}

std::vector<double> percentiles(std::vector<std::pair<double, double>> value_weight, std::span<const double> percents) {
  std::erase_if(value_weight, [](const auto& v) { return !std::isfinite(v.first); });
  std::sort(value_weight.begin(), value_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_weight) total += weight;
  std::vector<double> result;
  for (const double percent : percents) {
    double below = 0, found = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [value, weight] : value_weight) {
      below += weight;
      found = value;
      if (below >= percent / 100 * total) break;
    }
    result.push_back(found);
  }
  return result;
}

}  // namespace tunica::analysis
