// From the engine's mesh to one that a case can be computed on: named regions and faces, lumen and wall with nodes of
// their own.
#pragma once

#include "tunica/geometry/openings.hpp"
#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::meshing {

inline constexpr const char *lumen_interface = "lumen_wall", *wall_interface = "wall_inner";

/// Sorts the surface triangles by face. Throws SolverError when a cap or ring has no triangle, or one of the lumen lies
/// outside of all openings.
struct SurfaceFaces {
  std::vector<std::vector<std::array<geometry::Index, 3>>> caps, rings;  ///< lumen and wall, for each opening
  std::vector<std::array<geometry::Index, 3>> interface, outer;  ///< as seen from outside the lumen, and the body
};
SurfaceFaces sort_surface(const geometry::Tetrahedra& mesh, const std::vector<geometry::Opening>& openings);

/// Regions `lumen` and the wall regions that occur; faces `lumen_<opening>`, `wall_<opening>`, `lumen_wall`,
/// `wall_inner`, `wall_outer`; nodes of the interface are there twice, as twins. With a false lumen the nodes of the
/// lumen have mesh::lumen_side, so that one alone, in a rigid wall, knows its lumens.
mesh::MeshData assemble(const geometry::Tetrahedra& mesh, const std::vector<geometry::Opening>& openings,
                        const SurfaceFaces& faces, const WallRegions& regions);

}  // namespace tunica::meshing
