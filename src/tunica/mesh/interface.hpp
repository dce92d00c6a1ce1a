// Joins meshes of lumen and wall into one and pairs the nodes of their common surfaces.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/mesh/loaded_mesh.hpp"

namespace tunica::mesh {

/// A surface that lumen and wall have in common: all triangles of the lumen's faces together coincide with all
/// triangles of the wall's faces together.
struct Interface {
  std::vector<std::string> lumen_faces, wall_faces;
};

struct JoinOptions {
  double tolerance = 1e-3;  ///< distance of a pair, as a share of the shortest edge at the lumen node; in (0, 0.5)
};

/// Puts `parts` one after the other and fills `twins` for each of `interfaces`. Wall nodes of a pair get exactly the
/// coordinates of their lumen node. The report goes on with one line per interface (pairs, largest distance).
///
/// Throws InputError when names of regions or faces are not unique, there is more than one lumen, an interface names a
/// face that does not exist or lies on the wrong side, nodes of one side have no partner, or the triangles differ.
LoadedMesh join(std::span<const LoadedMesh> parts, std::span<const Interface> interfaces, const JoinOptions& options);

}  // namespace tunica::mesh
