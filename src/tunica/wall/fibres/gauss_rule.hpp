// Gauss quadrature fitted to a weight that no table covers.
#pragma once

#include <vector>

namespace tunica::wall {

struct Quadrature {
  std::vector<double> points, weights;
};

/// Composite Gauss-Legendre rule on [from, to] in equal panels of 20 points.
Quadrature composite_rule(double from, double to, int panels);

/// The rule of `count` points on [-1, 1] that integrates polynomials of degree 2 count - 1 against the even weight that
/// `measure` represents by many points in (0, 1], to which those in [-1, 0) are understood. Only the points >= 0 are
/// returned, in ascending order; the weights of all count points, both signs counted, sum to 1. Discretised Stieltjes
/// procedure (Gautschi 2004, section 2.2.3).
Quadrature even_gauss_rule(const Quadrature& measure, int count);

/// The same on [-1, 1] for a weight that is not even: `measure` covers all of it, all points are returned.
Quadrature gauss_rule(const Quadrature& measure, int count);

}  // namespace tunica::wall
