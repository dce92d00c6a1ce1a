// What the mesh resolves of convection, for the stabilisation of quadratic elements (docs/theory.md, eq. 2.5).
#pragma once

#include <span>
#include <vector>

#include "tunica/coupling/state.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// L2 projection of b.grad v [m/s^2] onto the continuous quadratic functions of the lumen (Codina 2002),
/// [local node][4] with ghosts up to date, zero outside the lumen; v and the position of the mesh are those of `state`,
/// b [m/s] is given as `stream`, [local node][4]. Throws SolverError where the iteration fails. Collective.
std::vector<double> resolved_convection(const distributed::DistributedMesh& mesh, const State& state,
                                        std::span<const double> stream);

}  // namespace tunica::coupling
