#include "tunica/assembly/krylov.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

using parallel::check;

struct Krylov::Implementation {
  KrylovSettings settings;
  LinearMap apply, precondition;
  parallel::MatHandle matrix;
  parallel::KspHandle ksp;
  parallel::VecHandle rhs, solution;
};

namespace {

PetscErrorCode map(const LinearMap& function, Vec x, Vec y) {
  PetscFunctionBeginUser;
  const double* in = nullptr;
  double* out = nullptr;
  PetscCall(VecGetArrayRead(x, &in));
  PetscCall(VecGetArrayWrite(y, &out));
  function(in, out);
  PetscCall(VecRestoreArrayWrite(y, &out));
  PetscCall(VecRestoreArrayRead(x, &in));
  PetscFunctionReturn(0);
}

PetscErrorCode apply_matrix(Mat matrix, Vec x, Vec y) {
  PetscFunctionBeginUser;
  LinearMap* function = nullptr;
  PetscCall(MatShellGetContext(matrix, &function));
  PetscCall(map(*function, x, y));
  PetscFunctionReturn(0);
}

PetscErrorCode apply_preconditioner(PC pc, Vec x, Vec y) {
  PetscFunctionBeginUser;
  LinearMap* function = nullptr;
  PetscCall(PCShellGetContext(pc, &function));
  PetscCall(map(*function, x, y));
  PetscFunctionReturn(0);
}

}  // namespace

Krylov::Krylov(MPI_Comm comm, std::int32_t owned, KrylovSettings settings, LinearMap apply, LinearMap precondition)
    : petsc_(std::make_unique<Implementation>()) {
  auto& p = *petsc_;
  p.settings = settings;
  p.apply = std::move(apply);
  p.precondition = std::move(precondition);
  check(VecCreateMPI(comm, owned, PETSC_DETERMINE, p.rhs.out()));
  check(VecDuplicate(p.rhs, p.solution.out()));
  check(MatCreateShell(comm, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, &p.apply, p.matrix.out()));
  check(MatShellSetOperation(p.matrix, MATOP_MULT, reinterpret_cast<void (*)()>(&apply_matrix)));
  check(KSPCreate(comm, p.ksp.out()));
  if (settings.method == KrylovSettings::Method::gmres) {
    check(KSPSetType(p.ksp, KSPGMRES));
    check(KSPGMRESSetRestart(p.ksp, settings.restart));
    check(KSPSetPCSide(p.ksp, PC_RIGHT));
  } else {
    check(KSPSetType(p.ksp, KSPCG));
    check(KSPSetNormType(p.ksp, KSP_NORM_UNPRECONDITIONED));
  }
  check(KSPSetOperators(p.ksp, p.matrix, p.matrix));
  PC pc = nullptr;
  check(KSPGetPC(p.ksp, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &p.precondition));
  check(PCShellSetApply(pc, &apply_preconditioner));
}

Krylov::~Krylov() = default;

LinearResult Krylov::solve(std::span<const double> b, std::span<double> x, double absolute) {
  auto& p = *petsc_;
  double* rhs = nullptr;
  check(VecGetArrayWrite(p.rhs, &rhs));
  std::copy(b.begin(), b.end(), rhs);
  check(VecRestoreArrayWrite(p.rhs, &rhs));
  double b_norm = 0;
  check(VecNorm(p.rhs, NORM_2, &b_norm));
  std::fill(x.begin(), x.end(), 0.0);
  if (!std::isfinite(b_norm)) return {0, b_norm, false};
  if (b_norm <= absolute) return {0, b_norm == 0.0 ? 0.0 : 1.0, true};

  check(KSPSetTolerances(p.ksp, p.settings.tolerance, absolute, 1e10, p.settings.max_iterations));
  check(KSPSolve(p.ksp, p.rhs, p.solution));
  LinearResult result;
  PetscInt iterations = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetIterationNumber(p.ksp, &iterations));
  check(KSPGetResidualNorm(p.ksp, &result.residual));
  check(KSPGetConvergedReason(p.ksp, &reason));
  result.iterations = static_cast<int>(iterations);
  result.residual /= b_norm;
  result.converged = reason > 0;
  const double* solution = nullptr;
  check(VecGetArrayRead(p.solution, &solution));
  std::copy(solution, solution + x.size(), x.begin());
  check(VecRestoreArrayRead(p.solution, &solution));
  return result;
}

}  // namespace tunica::assembly
