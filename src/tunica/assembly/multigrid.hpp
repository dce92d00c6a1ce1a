// Algebraic multigrid for the scalar elliptic matrices inside the preconditioners.
#pragma once

#include <mpi.h>

#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

/// One BoomerAMG V-cycle, not yet bound to a matrix. HMIS coarsening with one aggressive level and extended+i
/// interpolation of at most four entries keeps the operator complexity of 3D Laplacians below 1.5 (De Sterck, Yang &
/// Heys 2006). One Gauss-Seidel sweep forward before and backward after the coarse correction: half the cost of
/// symmetric sweeps, and the cycle as a whole is still symmetric, as conjugate gradients need. Collective.
parallel::PcHandle make_multigrid(MPI_Comm comm);

}  // namespace tunica::assembly
