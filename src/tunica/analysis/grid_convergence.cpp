#include "tunica/analysis/grid_convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tunica::analysis {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double reliable = 1.25, unreliable = 3.0;
constexpr double lowest_order = 0.5, tolerance_of_order = 0.1;
constexpr double steepest = 12.0;  // above it an order is not looked for

/// (h0^p - h1^p) / (h1^p - h2^p), which grows with p.
double ratio_of_increments(const double (&h)[3], double p) {
  return (std::pow(h[0], p) - std::pow(h[1], p)) / (std::pow(h[1], p) - std::pow(h[2], p));
}

double observed_order(const double (&h)[3], double ratio) {
  double low = 1e-3, high = steepest;
  if (ratio <= ratio_of_increments(h, low)) return low;
  if (ratio >= ratio_of_increments(h, high)) return high;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (ratio_of_increments(h, middle) < ratio ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// To size zero, from the two finest.
double extrapolate(double h1, double f1, double h2, double f2, double order) {
  const double a = std::pow(h1, order), b = std::pow(h2, order);
  return f2 + (f2 - f1) * b / (a - b);
}

}  // namespace

std::string ErrorBand::text() const {
  switch (kind) {
    case Kind::one_level:
      return "one level";
    case Kind::two_levels:
      return "two levels";
    case Kind::monotone:
      return "monotone";
    case Kind::oscillating:
      return "oscillating";
    case Kind::diverging:
      return "increments grow";
  }
  return "";
}

ErrorBand error_band(std::span<const double> sizes, std::span<const double> values, double formal_order) {
  const std::size_t n = sizes.size();
  if (n == 0 || values.size() != n) throw std::invalid_argument("error_band: one value for each size");
  for (std::size_t k = 0; k + 1 < n; ++k)
    if (!(sizes[k + 1] < sizes[k])) throw std::invalid_argument("error_band: sizes have to fall");
  using Kind = ErrorBand::Kind;
  if (n == 1) return {Kind::one_level, none, none, none};
  if (n == 2) {
    const double f = extrapolate(sizes[0], values[0], sizes[1], values[1], formal_order);
    return {Kind::two_levels, unreliable * std::abs(values[0] - f), f, formal_order};
  }
  const double h[3] = {sizes[n - 3], sizes[n - 2], sizes[n - 1]};
  const double f[3] = {values[n - 3], values[n - 2], values[n - 1]};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double range = *largest - *least;
  if (f[0] == f[1] && f[1] == f[2])
    return {Kind::monotone, unreliable * range, f[2], formal_order};  // converged to the last digit
  const double ratio = f[1] == f[2] ? std::numeric_limits<double>::infinity() : (f[0] - f[1]) / (f[1] - f[2]);
  if (ratio < 0) return {Kind::oscillating, unreliable * range, none, none};
  if (!(ratio > ratio_of_increments(h, 1e-3))) return {Kind::diverging, unreliable * range, none, none};
  const double order = observed_order(h, ratio);
  const bool trusted = order >= lowest_order && order <= formal_order + tolerance_of_order;
  const double used = std::clamp(order, lowest_order, formal_order + tolerance_of_order);
  const double exact = extrapolate(h[1], f[1], h[2], f[2], used);
  return {Kind::monotone, (trusted ? reliable : unreliable) * std::abs(values[0] - exact), exact, order};
}

}  // namespace tunica::analysis
