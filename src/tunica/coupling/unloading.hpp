// The wall between its imaged shape and a stress-free one (docs/theory.md, section 5).
#pragma once

#include <optional>
#include <span>

#include "tunica/coupling/wall_prestress.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// dx/dX at a point (prestress_points) of a wall element for a field of displacements [m] of the imaged shape, global
/// axes: `displacement` holds three components for each local node, `stride` numbers apart.
Mat3<double> motion_gradient(const distributed::DistributedMesh& mesh, std::span<const double> displacement, int stride,
                             const distributed::Region& region, std::size_t element, int point);

/// R of F = R U, det F > 0 (Higham 1986, doi:10.1137/0907079).
Mat3<double> rotation_of(const Mat3<double>& F);

/// The prestretch of a wall whose stress-free shape lies at x - U, (5.7): V_0 = F_0 R_0^T, F_0 = (I - grad U)^-1. The
/// directions of fibres are those of the imaged shape, and turn with R_0 from the stress-free one. `unloading`: U [m],
/// [local node][3]. None where an element of this rank would be inverted in the stress-free shape. Not collective.
std::optional<WallPrestress> prestretch_of(const distributed::DistributedMesh& mesh, std::span<const double> unloading);

}  // namespace tunica::coupling
