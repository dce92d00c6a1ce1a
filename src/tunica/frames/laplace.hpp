// -div grad phi = 0 on a part of the mesh: docs/theory.md, section 6.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/frames/settings.hpp"

namespace tunica::frames {

/// What holds on the boundary; no flux elsewhere. Arrays are [local node], of which those of owned nodes count.
struct LaplaceConditions {
  std::vector<double> value;  ///< of phi where it is prescribed, NaN elsewhere
  std::vector<double> group;  ///< number of the group of nodes that have one unknown phi in common, -1: none
  std::vector<double> flux;   ///< inflow into each group [m^2 times the unit of the gradient]; the same on all ranks

  explicit LaplaceConditions(const distributed::DistributedMesh& mesh);
};

struct LaplaceSolution {
  std::vector<double> phi;  ///< [local node], ghosts up to date; nodes outside the domain hold 0
  int iterations = 0;
};

/// Linear elements. A prescribed value goes before a group. In the union, twins of the interface are one unknown; there
/// and in the conditions the value at a host counts for both. Throws SolverError when nothing is prescribed or the
/// linear solver fails; `name` begins the message. Collective.
LaplaceSolution solve_laplace(const distributed::DistributedMesh& mesh, Domain domain,
                              const LaplaceConditions& conditions, const std::string& name);

/// Node that carries phi of `node`.
inline std::int32_t carrier(const distributed::DistributedMesh& mesh, Domain domain, std::int32_t node) {
  return domain == Domain::lumen_and_wall ? mesh.host[node] : node;
}

/// Whether elements of a region of this kind belong to the domain.
bool includes(Domain domain, mesh::RegionKind kind);

}  // namespace tunica::frames
