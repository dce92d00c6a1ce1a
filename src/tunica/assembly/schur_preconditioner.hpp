// Preconditioner for the (v, p) system: incomplete factors of the velocity block, algebraic multigrid on the pressure
// Schur complement.
//
//   [K G] ~ [I       0] [K^ 0] [I  K^-1 G]        K^: block ILU(0) of K on each rank,
//   [D L]   [D K^-1  I] [0  S] [0  I     ]        S = L - D diag(K)^-1 G, one BoomerAMG V-cycle.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tunica/assembly/block_kernels.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/mesh/distributed_mesh.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

class SchurPreconditioner {
 public:
  SchurPreconditioner(const mesh::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa);

  /// Recomputes factors and multigrid hierarchy. Throws SolverError when a diagonal block is singular. Collective.
  void update(const BlockMatrix& matrix);

  /// z = M^-1 r, both [owned node][4]. Linear and fixed between updates. Collective.
  void apply(std::span<const double> r, std::span<double> z);

  /// Square roots of the diagonals of K and S, [owned node][4]: unknowns times these are comparable in size.
  const std::vector<double>& scale() const { return scale_; }

 private:
  void extract(const BlockMatrix& matrix);
  void factorise(const BlockMatrix& matrix);
  void build_schur(const BlockMatrix& matrix);

  const mesh::DistributedMesh& mesh_;
  const BlockPattern& pattern_;
  Isa isa_;

  // K: factors on owned columns.
  std::vector<std::int32_t> ilu_row_begin_, ilu_upper_begin_, ilu_columns_, ilu_source_, scratch_;
  std::vector<float> ilu_blocks_, ilu_inverse_diagonal_;
  IluFactors factors_;

  std::vector<float> divergence_, gradient_;  ///< D and G, [block][4], the fourth entry unused
  std::vector<double> inverse_diagonal_;      ///< 1 / diag(K), [local node][4]
  std::vector<double> scale_;

  parallel::MatHandle left_, right_, schur_;  ///< S = left right, left = [-D diag(K)^-1, L], right = [G; I]
  parallel::PcHandle multigrid_;
  parallel::VecHandle rhs_, solution_;
  std::vector<double> left_values_, right_values_;
  std::vector<float> z_;
  std::vector<double> halo_v_, halo_p_;
};

}  // namespace tunica::assembly
