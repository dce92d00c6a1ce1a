// Outlets couple all nodes of a face through their flow rate: A += coefficient s s^T, never stored as a matrix.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tunica::assembly {

/// s holds the area vectors of the nodes of one face, s_A = int N_A n dA [m^2], already projected on the free motions.
/// Only owned nodes are listed.
struct RankOne {
  double coefficient = 0;  ///< d(traction)/d(flow), times d(velocity)/d(unknown) [Pa s/m^3]
  std::vector<std::int32_t> nodes;
  std::vector<std::array<double, 3>> s;
};

}  // namespace tunica::assembly
