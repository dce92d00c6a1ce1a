// -div grad phi = 0 on a part of the mesh: docs/theory.md, section 6.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/mesh/distributed_mesh.hpp"

namespace tunica::frames {

enum class Domain { lumen, wall, lumen_and_wall };

/// What holds on the boundary; no flux elsewhere. Arrays are [local node].
struct LaplaceConditions {
  std::vector<double> value;  ///< of phi where it is prescribed, NaN elsewhere
  std::vector<double> flux;   ///< integral of the inflow over the node's share of the surface; of owned nodes

  explicit LaplaceConditions(const mesh::DistributedMesh& mesh);
};

struct LaplaceSolution {
  std::vector<double> phi;  ///< [local node], ghosts up to date; nodes outside the domain hold 0
  int iterations = 0;
};

/// Linear elements. In the union, twins of the interface are one unknown; there and in the conditions the value at a
/// host counts for both. Throws SolverError when nothing is prescribed or the linear solver fails; `name` begins the
/// message. Collective.
LaplaceSolution solve_laplace(const mesh::DistributedMesh& mesh, Domain domain, const LaplaceConditions& conditions,
                              const std::string& name);

/// Node that carries phi of `node`.
inline std::int32_t carrier(const mesh::DistributedMesh& mesh, Domain domain, std::int32_t node) {
  return domain == Domain::lumen_and_wall ? mesh.host[node] : node;
}

/// Whether elements of a region of this kind belong to the domain.
bool includes(Domain domain, mesh::RegionKind kind);

}  // namespace tunica::frames
