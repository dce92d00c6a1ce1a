#include "tunica/assembly/scalar_system.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tunica/assembly/multigrid.hpp"
#include "tunica/base/error.hpp"

namespace tunica::assembly {

using parallel::check;

ScalarSystem::ScalarSystem(const distributed::DistributedMesh& mesh, const ScalarEntries& entries, std::string name)
    : mesh_(mesh), name_(std::move(name)) {
  const PetscInt n = mesh.owned_nodes;
  check(MatCreate(mesh.comm, matrix_.out()));
  check(MatSetSizes(matrix_, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(matrix_, MATAIJ));
  // PETSc may reorder the indices that it is given.
  std::vector<PetscInt> rows = entries.rows, columns = entries.columns;
  check(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  check(MatSetValuesCOO(matrix_, entries.values.data(), INSERT_VALUES));
  check(MatCreateVecs(matrix_, solution_.out(), rhs_.out()));
  multigrid_ = make_multigrid(mesh.comm);
  check(KSPCreate(mesh.comm, krylov_.out()));
  check(KSPSetType(krylov_, KSPCG));
  check(KSPSetPC(krylov_, multigrid_));
  check(KSPSetOperators(krylov_, matrix_, matrix_));  // after KSPSetPC: they belong to the preconditioner
  check(KSPSetTolerances(krylov_, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 200));
}

std::vector<double> ScalarSystem::solve(std::span<const double> rhs) {
  double* b = nullptr;
  check(VecGetArrayWrite(rhs_, &b));
  std::copy(rhs.begin(), rhs.end(), b);
  check(VecRestoreArrayWrite(rhs_, &b));
  check(KSPSolve(krylov_, rhs_, solution_));
  KSPConvergedReason reason{};
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(krylov_, &reason));
  check(KSPGetIterationNumber(krylov_, &iterations));
  iterations_ = static_cast<int>(iterations);
  if (reason < 0)
    throw SolverError(fmt::format("{}: conjugate gradients failed after {} iterations (PETSc reason {}).", name_,
                                  iterations_, static_cast<int>(reason)));
  std::vector<double> nodal(static_cast<std::size_t>(mesh_.nodes()), 0.0);
  const double* x = nullptr;
  check(VecGetArrayRead(solution_, &x));
  std::copy(x, x + mesh_.owned_nodes, nodal.begin());
  check(VecRestoreArrayRead(solution_, &x));
  mesh_.halo.update(nodal, 1);
  return nodal;
}

}  // namespace tunica::assembly
