// Better shapes for a finished mesh: nodes are moved and elements reconnected where angles are worst.
#pragma once

#include <functional>
#include <string>

#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::meshing {

/// Moves `p`, which is near the surface between two labels (outside = 0), onto it; `normal` points from `from` to `to`.
/// False when there is no such surface within `reach` [m].
using Projection =
    std::function<bool(geometry::Point& p, const geometry::Point& normal, int from, int to, double reach)>;

struct ImproveOptions {
  double wanted_dihedral = 15;  ///< elements with a smaller (or larger than 180 - this) angle are worked on [degrees]
  double free_surface = 10;     ///< surfaces are changed only for elements with a smaller angle [degrees]
  /// Where nodes move, middles of surface triangles stay as near to the surface as they were, or nearer than this share
  /// of their longest edge and this distance [m].
  double deviation = 0.1, largest_deviation = 0.2e-3;
  int most_passes = 8;
  bool keep_layers = false;  ///< make no edge from one side of the wall to the other
};

struct Improvement {
  int passes = 0;
  geometry::Index moves = 0, reconnections = 0, collapses = 0, splits = 0;
};

/// Raises the worst sine of a dihedral angle around each node or reconnection; nothing gets worse. Inner nodes move
/// freely, nodes of a surface along it, nodes of curves not at all. Labels, surfaces and their topology stay what they
/// are. Elements keep positive volume. (Operations as in Klingner & Shewchuk 2008, Proc. 16th Meshing Roundtable,
/// 3-23.)
Improvement improve(geometry::Tetrahedra& mesh, const Projection& project, const ImproveOptions& options,
                    const std::function<void(const std::string&)>& tell);

}  // namespace tunica::meshing
