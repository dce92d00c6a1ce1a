// Forces of the viscosity of the wall (wall/viscous_forces.hpp), in a loop of its own: most walls have none.
#pragma once

#include <span>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/coupling/loop_views.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/wall/viscous_forces.hpp"

namespace tunica::coupling {

/// Adds the forces with displacement and velocity of `fields` to the residual [N], [local node][4], and where `matrix`
/// is given, their tangent.
void add_wall_viscosity(const distributed::DistributedMesh& mesh, const assembly::BlockPattern& pattern,
                        const wall::Viscosity& viscosity, const FieldsView& fields,
                        const wall::ViscousCoefficients& coefficients, std::span<double> residual,
                        assembly::BlockMatrix* matrix);

}  // namespace tunica::coupling
