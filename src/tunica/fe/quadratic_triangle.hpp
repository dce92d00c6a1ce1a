// The quadratic triangle with straight edges: corners 0-2, then nodes in the middle of the edges 01 12 20.
#pragma once

#include <array>

#include "tunica/base/tensor.hpp"

namespace tunica::fe {

/// A point of a quadrature rule on the triangle, with the shape functions there.
struct QuadraticTrianglePoint {
  double barycentric[3];
  double weight;  ///< all weights sum to one
  double N[6];
};

/// Seven points, exact for degree 5 (Radon 1948).
inline constexpr std::array<QuadraticTrianglePoint, 7> quadratic_seven_points = [] {
  std::array<QuadraticTrianglePoint, 7> rule{};
  int q = 0;
  const auto add = [&](double l0, double l1, double l2, double weight) {
    rule[q++] = {{l0, l1, l2},
                 weight,
                 {l0 * (2 * l0 - 1), l1 * (2 * l1 - 1), l2 * (2 * l2 - 1), 4 * l0 * l1, 4 * l1 * l2, 4 * l2 * l0}};
  };
  add(1.0 / 3, 1.0 / 3, 1.0 / 3, 0.225);
  const double group[2][2] = {{0.059715871789769820459, 0.13239415278850618074},
                              {0.79742698535308732240, 0.12593918054482715260}};
  for (const auto& [a, w] : group) {
    const double b = 0.5 * (1 - a);
    add(a, b, b, w);
    add(b, a, b, w);
    add(b, b, a, w);
  }
  return rule;
}();

}  // namespace tunica::fe
