// The meshing engine: Delaunay refinement with CGAL's Mesh_3, behind types of our own.
#pragma once

#include <functional>
#include <string>

#include "tunica/stages/meshing/tetrahedra.hpp"

namespace tunica::stages::meshing {

/// Told when a phase begins and every second or so within it: name, numbers so far.
using MeshingProgress = std::function<void(const std::string& phase, const std::string& state)>;

struct TetrahedraliseOptions {
  double exude_seconds = 60;  ///< limit of the sliver exudation; 0: leave it out
};

/// Meshes all labels of `domain` at once. Deterministic. Throws SolverError when no element results.
Tetrahedra tetrahedralise(const LabelDomain& domain, const TetrahedraliseOptions& options,
                          const MeshingProgress& progress);

}  // namespace tunica::stages::meshing
