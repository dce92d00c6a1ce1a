// Nodes in the middle of edges: what makes a mesh of linear tetrahedra one of quadratic ones.
#pragma once

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// Adds one node for each edge of the tetrahedra after the nodes there are, in the order in which the edges are met,
/// and fills MeshData::edges and FaceData::edges. Edges stay straight. Node fields take the mean of both ends. Where a
/// wall triangle lies on a lumen triangle (all its corners have twins), the nodes on its edges become twins, too.
/// `data` has linear elements.
void add_edge_nodes(MeshData& data);

/// The eight linear tetrahedra inside a quadratic one, by its ten nodes: four at the corners, four of the octahedron
/// between them.
inline constexpr int parts_of_tetrahedron[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                                   {4, 8, 6, 7}, {4, 5, 6, 8}, {6, 8, 9, 7}, {6, 5, 9, 8}};

/// The linear mesh on all nodes of a quadratic one: eight tetrahedra in place of one, in its order (8 e .. 8 e + 7 are
/// those of element e), and four triangles in place of one. What is quadratic is seen by analyses that know linear
/// elements at all its nodes.
MeshData subdivided(const MeshData& data);

}  // namespace tunica::mesh
