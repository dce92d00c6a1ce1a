// The meshing engine: Delaunay refinement with CGAL's Mesh_3, behind types of our own.
#pragma once

#include <functional>
#include <string>

#include "tunica/stages/meshing/tetrahedra.hpp"

namespace tunica::stages::meshing {

/// Told when a phase begins and every second or so within it: name, numbers so far.
using MeshingProgress = std::function<void(const std::string& phase, const std::string& state)>;

/// Meshes all labels of `domain` at once. Deterministic. There are slivers in the result, which improve() takes out
/// faster than CGAL's exudation. Throws SolverError when there is no surface in the box.
Tetrahedra tetrahedralise(const LabelDomain& domain, const MeshingProgress& progress);

}  // namespace tunica::stages::meshing
