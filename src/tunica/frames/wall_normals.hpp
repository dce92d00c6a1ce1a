// The direction across the wall, e3, in every element: docs/theory.md, section 6.
#pragma once

#include <string>
#include <vector>

#include "tunica/frames/element_graph.hpp"
#include "tunica/frames/settings.hpp"

namespace tunica::frames {

struct WallNormals {
  std::vector<double> direction;  ///< [element of the graph, ghosts included][3], unit, from the lumen into the wall
  std::vector<double> agreement;  ///< of owned elements: 1 where the neighbourhood has one direction, 0: none
};

/// From outward normals of `inner_faces` (the interface, on the wall's side). For conditional means they are carried
/// into the wall layer by layer across faces of elements, then averaged; filtered dyads take their sign from vectors
/// so carried. Throws InputError on all ranks when a face does not exist, or when no path leads from them to some
/// element. Collective.
WallNormals wall_normals(const ElementGraph& graph, const std::vector<std::string>& inner_faces,
                         const NormalMethod& method);

}  // namespace tunica::frames
