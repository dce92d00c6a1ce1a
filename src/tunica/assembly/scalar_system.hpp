// Elliptic problems with one unknown for each node: set-up of frames and blends, nothing that is solved every step.
#pragma once

#include <petscsystypes.h>

#include <span>
#include <string>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

/// Entries by global node numbers; repeated ones are added, those of rows of other ranks travel there.
struct ScalarEntries {
  std::vector<PetscInt> rows, columns;
  std::vector<PetscScalar> values;

  void add(std::int64_t row, std::int64_t column, double value) {
    rows.push_back(static_cast<PetscInt>(row));
    columns.push_back(static_cast<PetscInt>(column));
    values.push_back(value);
  }
};

/// A symmetric positive definite matrix, solved by conjugate gradients with multigrid.
class ScalarSystem {
 public:
  /// Every owned node needs a diagonal entry. `name` begins the messages of errors. Collective.
  ScalarSystem(const distributed::DistributedMesh& mesh, const ScalarEntries& entries, std::string name);

  /// Solution on all local nodes, ghosts included, to a relative residual of 1e-10 in the norm of the preconditioner.
  /// `rhs`: of the owned nodes. Throws SolverError when 200 iterations do not suffice. Collective.
  std::vector<double> solve(std::span<const double> rhs);
  int iterations() const { return iterations_; }  ///< of the last solve

 private:
  const distributed::DistributedMesh& mesh_;
  std::string name_;
  int iterations_ = 0;
  parallel::MatHandle matrix_;
  parallel::VecHandle solution_, rhs_;
  parallel::PcHandle multigrid_;
  parallel::KspHandle krylov_;
};

}  // namespace tunica::assembly
