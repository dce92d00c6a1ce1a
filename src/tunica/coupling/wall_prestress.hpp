#pragma once

#include <vector>

#include "tunica/wall/quadratic_element.hpp"

namespace tunica::coupling {

/// Prestress of all local wall elements, ghosts included, at their points of quadrature (prestress_points).
struct WallPrestress {
  wall::PrestressKind kind = wall::PrestressKind::none;
  std::vector<std::vector<double>> values{};  ///< [region of the mesh][element][point][component], global axes
};

/// Points of an element that have a prestress each.
constexpr int prestress_points(bool quadratic) { return quadratic ? wall::quadratic::points : 1; }

}  // namespace tunica::coupling
