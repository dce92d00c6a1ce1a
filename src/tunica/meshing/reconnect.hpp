// Changes of the connections around one element of bad shape.
#pragma once

#include "tunica/meshing/local_mesh.hpp"

namespace tunica::meshing {

struct ReconnectOptions {
  bool keep_layers = false;   ///< make no edge from one side of the wall to the other
  bool keep_surface = false;  ///< leave the edges of surfaces as they are
};

/// Removes one of the element's edges, or replaces one of its faces by an edge, whichever raises the worst sine of the
/// elements concerned most; edges on a surface too, where it stays smooth. False when nothing helps.
bool reconnect(LocalMesh& mesh, LocalMesh::Cell cell, const ReconnectOptions& options);

/// Moves one node of the element into another and takes it out, if that raises the worst sine. Inner nodes only.
bool collapse(LocalMesh& mesh, LocalMesh::Cell cell, const ReconnectOptions& options);

/// Moves an inner node into the inner neighbour where the worst sine around it stays highest, if that is at least
/// `least_sine` or no worse than before. Makes no edge from one side of the wall to the other.
bool merge_into_neighbour(LocalMesh& mesh, LocalMesh::Node node, double least_sine);

}  // namespace tunica::meshing
