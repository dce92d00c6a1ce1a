#include "tunica/assembly/multigrid.hpp"

#include <petscpc.h>

#include <initializer_list>
#include <string>
#include <utility>

#include "tunica/parallel/message.hpp"

namespace tunica::assembly {

using parallel::check;

namespace {

using Options = std::initializer_list<std::pair<const char*, const char*>>;

/// Not yet bound to a matrix. `options`: names behind `prefix`, which is this kind's alone. They stay in the options of
/// the process, since parts of the preconditioner that come with its set-up read them there.
parallel::PcHandle make_preconditioner(MPI_Comm comm, const std::string& prefix, PCType type, const Options& options) {
  for (const auto& [key, value] : options) check(PetscOptionsSetValue(nullptr, ("-" + prefix + key).c_str(), value));
  parallel::PcHandle result;
  check(PCCreate(comm, result.out()));
  check(PCSetOptionsPrefix(result, prefix.c_str()));
  check(PCSetType(result, type));
  check(PCSetFromOptions(result));
  return result;
}

}  // namespace

parallel::PcHandle make_multigrid(MPI_Comm comm) {
  return make_preconditioner(comm, "tunica_", PCHYPRE,
                             {{"pc_hypre_type", "boomeramg"},
                              {"pc_hypre_boomeramg_coarsen_type", "HMIS"},
                              {"pc_hypre_boomeramg_interp_type", "ext+i"},
                              {"pc_hypre_boomeramg_strong_threshold", "0.5"},
                              {"pc_hypre_boomeramg_P_max", "4"},
                              {"pc_hypre_boomeramg_agg_nl", "1"},
                              {"pc_hypre_boomeramg_relax_type_down", "SOR/Jacobi"},
                              {"pc_hypre_boomeramg_relax_type_up", "backward-SOR/Jacobi"}});
}

parallel::PcHandle make_elastic_multigrid(MPI_Comm comm) {
  return make_preconditioner(comm, "tunica_wall_", PCGAMG,
                             {{"pc_gamg_type", "agg"},
                              {"pc_gamg_agg_nsmooths", "1"},
                              {"pc_gamg_threshold", "0.05"},
                              {"pc_gamg_reuse_interpolation", "false"},
                              {"mg_levels_ksp_type", "chebyshev"},
                              {"mg_levels_ksp_max_it", "2"},
                              {"mg_levels_pc_type", "jacobi"}});
}

void set_up_elastic_multigrid(PC multigrid, Mat matrix) {
  check(PCSetOperators(multigrid, matrix, matrix));
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(multigrid), &comm));
  // The usual product adds what three and more ranks contribute as their messages arrive, so that runs differ in their
  // last digits; two ranks have one order only, and for them it is much the faster one. The option has no prefix: it is
  // taken back, so that products elsewhere in the process are not touched.
  constexpr const char* product = "-matptap_via";
  const bool several = parallel::size(comm) > 2;
  if (several) check(PetscOptionsSetValue(nullptr, product, "allatonce"));
  check(PCSetUp(multigrid));
  if (several) check(PetscOptionsClearValue(nullptr, product));
}

}  // namespace tunica::assembly
