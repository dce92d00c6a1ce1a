// How well a mesh keeps the surfaces that it was made from.
#pragma once

#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/meshing/patient_complex.hpp"

namespace tunica::meshing {

/// One surface of the mesh against the mended and flattened one.
struct SurfaceFidelity {
  double largest_distance = 0;  ///< both ways, at nodes and triangle centres [m]
  double largest_per_edge = 0;  ///< the same over the edge length asked for there
};
struct Fidelity {
  SurfaceFidelity lumen, outer;
  double lumen_volume = 0, wall_volume = 0;  ///< of the surfaces given, closed at the openings [m^3]
};

/// `interface`, `outer`: triangles of the mesh (`sort_surface`).
Fidelity fidelity(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 3>>& interface,
                  const std::vector<std::array<geometry::Index, 3>>& outer, const PreparedSurfaces& prepared);

}  // namespace tunica::meshing
