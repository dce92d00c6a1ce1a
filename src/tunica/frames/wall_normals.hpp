// The direction across the wall, e3, in every element: docs/theory.md, section 6.
#pragma once

#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tunica/frames/element_graph.hpp"

namespace tunica::frames {

/// Directions without sign: dyads of the interface normals are spread through the wall by a filter, and the principal
/// direction of what arrives is taken, eq. (6.3). With a length of about the thickness of the wall or more, the broad
/// sides of a flap prevail over the rims of its tears, however fine the mesh.
struct FilteredDyads {
  double length = 2e-3;  ///< over which the influence of the interface decays [m], > 0
};

/// Vectors: a neighbour counts when its angle to the element's own vector is within the tolerance, eq. (6.1), (6.2).
struct ConditionalMean {
  double tolerance = 120 * std::numbers::pi / 180;  ///< rad, in (0, pi]
  int cycles = 5;
};

using NormalMethod = std::variant<FilteredDyads, ConditionalMean>;

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
