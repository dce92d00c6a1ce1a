// How material directions are found: docs/theory.md, section 6.
#pragma once

#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace tunica::frames {

enum class Domain { lumen, wall, lumen_and_wall };

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

struct FrameSettings {
  NormalMethod normal = FilteredDyads{};
  Domain domain = Domain::lumen_and_wall;  ///< where the Laplace problem is solved
};

/// Wall regions along the two lumens.
struct LumenWalls {
  std::vector<std::string> true_lumen, false_lumen;
};

}  // namespace tunica::frames
