// Quantities of a cycle from samples in time: docs/theory.md, section 10.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::analysis {

/// Weights of the trapezoidal rule at ascending instants; they add up to the length of the window.
std::vector<double> trapezoid_weights(std::span<const double> times);

/// d/dt at one of at least three ascending instants by the parabola through it and its neighbours (at an end through
/// the next two), second-order accurate: sum of weights[i] * value[first + i].
struct Derivative {
  std::size_t first;
  std::array<double, 3> weights;
};
Derivative derivative_at(std::span<const double> times, std::size_t k);

/// Sums over time of one quantity with the weights of the trapezoidal rule.
struct Course {
  double mean = 0, largest = 0, smallest = 0;
  double time_of_largest = 0, time_of_smallest = 0;
  double forward = 0, backward = 0;  ///< integrals of the positive and of the negative part, both >= 0
};
Course course(std::span<const double> times, std::span<const double> values);

/// Time-averaged wall shear stress [Pa], oscillatory shear index and relative residence time [1/Pa], eqs (10.1)-(10.3).
struct ShearFigures {
  double tawss = 0, osi = 0, rrt = 0;  ///< rrt is infinite where the mean vector vanishes
};
ShearFigures shear_figures(double magnitude_integral, const Vec3<double>& vector_integral, double duration);

/// Smallest values that at least p % of the weight do not exceed, for each p of `percents`, eq. (10.4). Values that are
/// no numbers are left out; NaN when none is left.
std::vector<double> percentiles(std::vector<std::pair<double, double>> value_weight, std::span<const double> percents);

}  // namespace tunica::analysis
