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

/// One V-cycle of smoothed aggregation (PETSc's GAMG), not yet bound to a matrix of 3 x 3 blocks that carries its near
/// null space. Two steps of Chebyshev iteration on the diagonal before and after: Gauss-Seidel sweeps of PETSc 3.18
/// divide by zero on coarse levels of some walls, and these are the same on any number of ranks. Aggregates are
/// found anew for every matrix, so that a run that was stopped goes on bit for bit. Collective.
parallel::PcHandle make_elastic_multigrid(MPI_Comm comm);

/// Sets up the cycle for `matrix`, the same bit for bit in every run: coarse matrices by PETSc's products "all at once",
/// since its others add what three and more ranks contribute as the messages arrive. Collective.
void set_up_elastic_multigrid(PC multigrid, Mat matrix);

}  // namespace tunica::assembly
