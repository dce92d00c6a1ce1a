// The meshing engine: fills a closed complex of triangles with tetrahedra, by TetGen behind types of our own.
#pragma once

#include <functional>

#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/meshing/surface_complex.hpp"

namespace tunica::meshing {

struct FillSettings {
  double in_lumen = 1.0;  ///< edge length inside over that of the surfaces around
  double in_wall = 2.0;   ///< hardly any node is added inside the wall: its surfaces are about one edge apart
  /// Edge length [m] inside the lumen near a point of its surface, in place of `in_lumen`; none when empty.
  std::function<double(const geometry::Point&)> lumen_size{};
};

/// Fills lumen and wall, each on its own; they share the triangles of `complex`, which all become faces of tetrahedra.
/// `size(x)` [m] is the wanted edge length at a point of the complex. Elements are refined until the ratio of the
/// radius of the ball around them to their shortest edge is below 1.4 and dihedral angles are above 10 degrees, except
/// where the given triangles forbid it; improve() does the rest. Throws SolverError with TetGen's reason. (Si 2015, ACM
/// TOMS 41, 11.)
geometry::Tetrahedra tetrahedralise(const SurfaceComplex& complex,
                                    const std::function<double(const geometry::Point&)>& size,
                                    const FillSettings& settings);

}  // namespace tunica::meshing
