// What the conditions of its faces leave free of a node.
#pragma once

#include <cmath>
#include <vector>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// Directions in which a node is held; the free motions are what is orthogonal to them.
struct Held {
  Mat3<double> P = identity<double>();  ///< projector on the free motions
  bool pressure = false;                ///< the node has no pressure unknown
  bool unused = false;                  ///< since no element has one there

  void all() { P = Mat3<double>{}; }
  /// Of any length but zero.
  void direction(const Vec3<double>& n);
  bool any() const { return pressure || std::abs(trace(P) - 3.0) > 1e-12; }
};

/// The nodes of `held` [owned node] that are held, ghosts included. Ghosts on a face may lie outside every face
/// triangle that this rank sees, so they ask their owners. Collective.
std::vector<assembly::NodeConstraint> complete_on_ghosts(const distributed::DistributedMesh& mesh,
                                                         const std::vector<Held>& held);

/// A corner whose pressure nothing balances, and the other corners of its elements.
struct IdlePressure {
  std::int32_t node;  ///< owned
  std::vector<std::int32_t> corners;
};

/// Of quadratic elements of a lumen: corners with no free velocity in any of their elements, such as a tetrahedron with
/// three faces on rigid walls has. The equations do not know their pressure. Empty for linear elements. Collective.
std::vector<IdlePressure> find_idle_pressures(const distributed::DistributedMesh& mesh, const std::vector<Held>& held);

}  // namespace tunica::coupling
