// How deep in the wall a place lies: docs/theory.md, section 6.
#pragma once

#include <string>
#include <vector>

#include "tunica/frames/element_graph.hpp"

namespace tunica::frames {

/// Depth at the corners of the owned elements of the graph, [element][4]: harmonic in the wall, 0 on the faces `inner`
/// and 1 on the faces `outer`; 0 throughout a flap that is wetted on both sides. Throws InputError for a face that does
/// not exist, SolverError when the Laplace problem cannot be solved. Collective.
std::vector<double> depths(const ElementGraph& graph, const std::vector<std::string>& inner,
                           const std::vector<std::string>& outer);

}  // namespace tunica::frames
