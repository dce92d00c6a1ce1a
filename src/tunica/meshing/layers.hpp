// More than one element through thin walls.
#pragma once

#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::meshing {

/// Halves every edge of a wall element that reaches from one side of the wall to the other (`bridges`), so that the
/// wall is at least two elements thick everywhere, and then takes out those of the new nodes that it can do without.
/// Leaves flat elements for improve() with `keep_layers`. Returns the number of nodes that it has added.
geometry::Index double_layers(geometry::Tetrahedra& mesh, std::vector<std::array<geometry::Index, 2>> bridges);

}  // namespace tunica::meshing
