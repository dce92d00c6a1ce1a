// The inside of the vessel: the triangles that blood sticks to, and the elements of the lumen behind them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunica/coupling/problem.hpp"

namespace tunica::quantities {

struct InsideTriangle {
  std::array<std::int32_t, 3> nodes;  ///< local
  std::array<std::int32_t, 4> element;
  std::array<std::int32_t, 6> edges;  ///< of the element; quadratic ones only
};

/// Those of interfaces and of faces without slip. Every triangle at an owned node is among them.
std::vector<InsideTriangle> inside_of(const coupling::Problem& problem);

}  // namespace tunica::quantities
