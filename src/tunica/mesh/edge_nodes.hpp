// Nodes in the middle of edges: what makes a mesh of linear tetrahedra one of quadratic ones.
#pragma once

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// Adds one node for each edge of the tetrahedra after the nodes there are, in the order in which the edges are met,
/// and fills MeshData::edges and FaceData::edges. Edges stay straight. Node fields take the mean of both ends. Where a
/// wall triangle lies on a lumen triangle (all its corners have twins), the nodes on its edges become twins, too.
/// `data` has linear elements.
void add_edge_nodes(MeshData& data);

}  // namespace tunica::mesh
