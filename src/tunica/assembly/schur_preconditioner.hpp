// Preconditioner for the (v, p) system, of the SIMPLE type: incomplete factors of the velocity block, algebraic
// multigrid on the pressure Schur complement.
//
//   [K G] ~ [K^ 0] [I  H G]        K^: block ILU(0) of K on each rank,       H: inverse of a diagonal of K,
//   [D L]   [D  S] [0  I  ]        S ~ L - D H G, one BoomerAMG V-cycle.
//
// D H G is a Laplacian weighted with (nodal volume) / (nodal inertia and stiffness), so it is assembled as one, on the
// one-ring pattern of linear elements. The product of the matrices has 65 instead of 15 entries per row and makes the
// multigrid cycle four times as dear while it saves few iterations (figures in docs/performance.md).
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "tunica/assembly/block_kernels.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

class SchurPreconditioner {
 public:
  SchurPreconditioner(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa);

  /// Recomputes factors and multigrid hierarchy. Throws SolverError when a diagonal block is singular. Collective.
  void update(const BlockMatrix& matrix);

  /// z = M^-1 r, both [owned node][4]. Linear and fixed between updates. Collective.
  void apply(std::span<const double> r, std::span<double> z);

  /// Square roots of the diagonals of K and S, [owned node][4]: unknowns times these are comparable in size.
  const std::vector<double>& scale() const { return scale_; }

 private:
  void extract(const BlockMatrix& matrix);
  void factorise(const BlockMatrix& matrix);
  /// Factors with off-diagonal blocks divided by 1 + shift; returns a singular row or -1.
  std::int32_t factorise_shifted(const BlockMatrix& matrix, float shift);
  /// Do the factors take a vector like the diagonal of K to one of moderate size?
  bool factors_are_stable();
  void build_schur(const BlockMatrix& matrix);
  void make_laplacians();
  std::vector<double> mobility(const BlockMatrix& matrix);
  void add_free_boundary(const BlockMatrix& matrix);
  void add_free_quadratic_boundary(const BlockMatrix& matrix);

  const distributed::DistributedMesh& mesh_;
  const BlockPattern& pattern_;
  Isa isa_;

  // K: factors on owned columns.
  struct Triangle {
    std::vector<std::int32_t> row_begin{0}, columns, source;  ///< source: block of the matrix
    std::vector<float> blocks;

    IluFactors::Triangle view() { return {row_begin.data(), columns.data(), blocks.data()}; }
  };
  Triangle lower_, upper_;
  std::vector<float> inverse_blocks_;  ///< of the diagonal, [row][12]
  std::vector<std::int32_t> scratch_;
  IluFactors factors_;

  std::vector<float> divergence_, gradient_;  ///< D and G, [block][4], the fourth entry unused
  std::vector<double> scale_;

  // S: pressures couple over one ring of elements.
  struct Laplacian {
    std::array<std::int32_t, 6> nodes;  ///< whose mobility counts: corners (four), or those on the edges
    int count;
    std::array<float, 6> entries;        ///< V grad N_a . grad N_b for ab = 01 02 03 12 13 23 [m]
    std::array<std::int32_t, 16> slots;  ///< in pressure_pattern_; its number of blocks for ghost rows
  };
  BlockPattern pressure_pattern_;
  std::vector<std::int32_t> pressure_source_;  ///< [entry of pressure_pattern_]: block of the matrix
  std::vector<Laplacian> laplacians_;
  std::vector<char> follows_;                 ///< [local node]: belongs to the wall (twins included, hosts not)
  std::vector<double> nodal_volume_;          ///< [local node][1], m^3
  std::vector<distributed::EdgeNode> edges_;  ///< nodes on edges, local; empty for linear elements
  std::vector<double> schur_values_;
  std::vector<double> inverse_diagonal_;  ///< [owned node], 1 / (diagonal of K with the row sum of the mass)
  parallel::MatHandle schur_;
  parallel::PcHandle multigrid_;
  parallel::VecHandle rhs_, solution_;
  std::vector<float> z_, second_;
  std::vector<double> halo_v_, halo_p_;
};

}  // namespace tunica::assembly
