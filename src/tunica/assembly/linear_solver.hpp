// GMRES on the block matrix plus the rank-one terms of the outlets.
#pragma once

#include <span>
#include <vector>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/assembly/krylov.hpp"
#include "tunica/assembly/rank_one.hpp"
#include "tunica/assembly/schur_preconditioner.hpp"
#include "tunica/assembly/ties.hpp"

namespace tunica::assembly {

/// Solves (A + sum c_k s_k s_k^T) x = b. Right-preconditioned, so the residual that is tested is the true one, in a
/// norm where every equation is divided by the square root of its diagonal entry: momentum and continuity, fluid and
/// wall then weigh alike. With ties x is sought among the vectors that obey them, and the equations of tied nodes are
/// met in their sum (Galerkin): b must hold means there.
class LinearSolver {
 public:
  LinearSolver(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa, KrylovSettings settings,
               Ties ties = {});
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// New preconditioner for `matrix`. Collective.
  void update_preconditioner(const BlockMatrix& matrix, const std::vector<RankOne>& outlets);

  /// `rhs`: [owned node][4]; `x`: [local node][4], filled including ghosts. `absolute`: residual norm() that is small
  /// enough whatever the relative tolerance. Collective.
  LinearResult solve(const BlockMatrix& matrix, const std::vector<RankOne>& outlets, std::span<const double> rhs,
                     std::span<double> x, double absolute);

  /// Norm of a residual in the units of the solver, [owned node][4]. Collective.
  double norm(std::span<const double> residual) const;

 private:
  void multiply(const double* x, double* y);
  void precondition(const double* r, double* z);

  const distributed::DistributedMesh& mesh_;
  Isa isa_;
  Ties ties_;
  SchurPreconditioner preconditioner_;
  const BlockMatrix* matrix_ = nullptr;
  const std::vector<RankOne>* outlets_ = nullptr;

  std::vector<double> halo_, work_;
  Krylov krylov_;
};

}  // namespace tunica::assembly
