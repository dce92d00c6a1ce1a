#include "tunica/assembly/multigrid.hpp"

#include <petscpc.h>

#include <utility>

namespace tunica::assembly {

using parallel::check;

parallel::PcHandle make_multigrid(MPI_Comm comm) {
  for (const auto& [key, value] : {std::pair{"-tunica_pc_hypre_boomeramg_coarsen_type", "HMIS"},
                                   {"-tunica_pc_hypre_boomeramg_interp_type", "ext+i"},
                                   {"-tunica_pc_hypre_boomeramg_strong_threshold", "0.5"},
                                   {"-tunica_pc_hypre_boomeramg_P_max", "4"},
                                   {"-tunica_pc_hypre_boomeramg_agg_nl", "1"},
                                   {"-tunica_pc_hypre_boomeramg_relax_type_down", "SOR/Jacobi"},
                                   {"-tunica_pc_hypre_boomeramg_relax_type_up", "backward-SOR/Jacobi"}})
    check(PetscOptionsSetValue(nullptr, key, value));
  parallel::PcHandle multigrid;
  check(PCCreate(comm, multigrid.out()));
  check(PCSetOptionsPrefix(multigrid, "tunica_"));
  check(PCSetType(multigrid, PCHYPRE));
  check(PCHYPRESetType(multigrid, "boomeramg"));
  check(PCSetFromOptions(multigrid));
  return multigrid;
}

parallel::PcHandle make_elastic_multigrid(MPI_Comm comm) {
  for (const auto& [key, value] : {std::pair{"-tunica_wall_pc_gamg_type", "agg"},
                                   {"-tunica_wall_pc_gamg_agg_nsmooths", "1"},
                                   {"-tunica_wall_pc_gamg_threshold", "0.05"},
                                   {"-tunica_wall_pc_gamg_reuse_interpolation", "false"},
                                   {"-tunica_wall_mg_levels_ksp_type", "chebyshev"},
                                   {"-tunica_wall_mg_levels_ksp_max_it", "2"},
                                   {"-tunica_wall_mg_levels_pc_type", "jacobi"}})
    check(PetscOptionsSetValue(nullptr, key, value));
  parallel::PcHandle multigrid;
  check(PCCreate(comm, multigrid.out()));
  check(PCSetOptionsPrefix(multigrid, "tunica_wall_"));
  check(PCSetType(multigrid, PCGAMG));
  check(PCSetFromOptions(multigrid));
  return multigrid;
}

}  // namespace tunica::assembly
