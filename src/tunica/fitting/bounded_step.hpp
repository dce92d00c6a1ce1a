// A step of least squares that keeps to bounds.
#pragma once

#include <span>
#include <vector>

namespace tunica::fitting {

/// Of the unknowns, one each.
struct Box {
  std::vector<double> low, high;
};

/// The step d that minimises 2 g·d + d·N d with x + d within the bounds: a bound that is hit is kept, and the others
/// solve what is left. `normal`: N by rows; `gradient`: g; `held`: unknowns that stay.
std::vector<double> bounded_step(std::span<const double> normal, std::span<const double> gradient,
                                 std::span<const double> x, const Box& bounds, std::vector<bool> held);

}  // namespace tunica::fitting
