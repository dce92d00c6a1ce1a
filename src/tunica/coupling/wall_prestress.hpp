#pragma once

#include <vector>

#include "tunica/wall/prestress.hpp"

namespace tunica::coupling {

/// Prestress of all local wall elements, ghosts included.
struct WallPrestress {
  wall::PrestressKind kind = wall::PrestressKind::none;
  std::vector<std::vector<double>> values{};  ///< [region of the mesh][element][component], global axes
};

}  // namespace tunica::coupling
