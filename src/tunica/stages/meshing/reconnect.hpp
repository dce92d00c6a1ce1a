// Changes of the connections around one element of bad shape.
#pragma once

#include "tunica/stages/meshing/local_mesh.hpp"

namespace tunica::stages::meshing {

/// Removes one of the element's edges, or replaces one of its faces by an edge, whichever raises the worst sine of the
/// elements concerned most; edges on a surface too, where it stays smooth. False when nothing helps.
bool reconnect(LocalMesh& mesh, LocalMesh::Cell cell);

/// Moves one node of the element into another and takes it out, if that raises the worst sine. Inner nodes only.
bool collapse(LocalMesh& mesh, LocalMesh::Cell cell);

}  // namespace tunica::stages::meshing
