// Thin layers of elements at the wall of the lumen, where the velocity changes most.
#pragma once

#include <optional>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::meshing {

struct BoundaryLayers {
  int layers = 3;
  double thickness = 0.6e-3;  ///< of all layers together [m]
  double growth = 1.3;        ///< of each layer over the one nearer to the wall

  static config::Schema<BoundaryLayers> schema();
};

/// Thickness of all layers together over the interface nodes [m].
struct MadeLayers {
  double smallest = 0, median = 0, largest = 0;
};

/// Moves the lumen's elements away from the interface and fills the gap with prisms of three elements each. Surfaces
/// and volumes stay what they are, since only the lumen inside of them changes. Layers are thinner than asked where
/// elements behind them would lose more than half the sine of their worst dihedral angle and come below 8 degrees, or
/// prisms turn over: in narrow places and at rims of tears. Throws SolverError with places where no layer fits at all.
MadeLayers add_boundary_layers(geometry::Tetrahedra& mesh, const BoundaryLayers& settings);

}  // namespace tunica::meshing
