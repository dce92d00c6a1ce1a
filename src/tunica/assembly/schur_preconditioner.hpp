// Preconditioner for the (v, p) system,
//
//   [K G]      K^: block ILU(0) of K on each rank, and for walls a coarse correction beside it (wall_correction.hpp),
//   [D L] ,    S ~ L - D H G: H an inverse diagonal of K, one BoomerAMG V-cycle.
//
// Linear elements: of the SIMPLE type, [K^ 0; D S] [1 H G; 0 1]. Quadratic elements: [K^ G; 0 S], which has one solve
// with K^ as well; no diagonal stands for their mass, whose corners have a negative row sum.
//
// In the lumen, D H G is a Laplacian weighted with (nodal volume) / (nodal inertia and stiffness), so it is assembled
// as one, on the one-ring pattern of linear elements. The product of the matrices has 65 instead of 15 entries per row
// and makes the multigrid cycle four times as dear while it saves few iterations (figures in docs/performance.md). A
// wall is stiff against its inertia, so that D K^-1 G is like a mass matrix there: the diagonal of the same Laplacian.
//
// Outlets, A += c s s^T: K^ and H by the Sherman-Morrison-Woodbury formula, in S by what their resistance leaves of the
// yielding of their face. The formula for the whole of the preconditioner amplifies its errors: the small mobility of
// the vessel behind an outlet is a difference of the large ones of face and pressure (figures there too).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tunica/assembly/block_kernels.hpp"
#include "tunica/assembly/block_matrix.hpp"
#include "tunica/assembly/rank_one.hpp"
#include "tunica/assembly/wall_correction.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

class SchurPreconditioner {
 public:
  SchurPreconditioner(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, Isa isa);

  /// For `matrix` and the terms of the outlets that it does not hold: factors, coarse levels of the wall and of the
  /// pressure. Throws SolverError when a diagonal block is singular. Collective.
  void update(const BlockMatrix& matrix, const std::vector<RankOne>& outlets);

  /// z = M^-1 r, both [owned node][4]. Linear and fixed between updates. Collective.
  void apply(std::span<const double> r, std::span<double> z);

  /// Square roots of the diagonals of K and S, [owned node][4]: unknowns times these are comparable in size.
  const std::vector<double>& scale() const { return scale_; }

 private:
  void find_columns_with_pressure();
  void extract(const BlockMatrix& matrix);
  void factorise(const BlockMatrix& matrix);
  /// Factors with off-diagonal blocks divided by 1 + shift; returns a singular row or -1.
  std::int32_t factorise_shifted(const BlockMatrix& matrix, float shift);
  /// Do the factors take a vector like the diagonal of K to one of moderate size?
  bool factors_are_stable();
  void build_schur(const BlockMatrix& matrix, const std::vector<RankOne>& outlets);
  void find_yield(const std::vector<RankOne>& outlets);
  void find_free(const BlockMatrix& matrix);
  void times_inverse(std::span<double> z);         ///< z <- K^-1 z without the terms of the outlets
  void times_diagonal(std::span<double> z) const;  ///< z <- H z without them
  void solve_pressure(std::span<const double> rhs, std::span<double> z);
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

  struct Gradient {
    std::vector<std::int32_t> row_begin{0}, columns, source;  ///< source: block of the matrix
    std::vector<float> blocks;                                ///< [block][4], the fourth entry unused
  };
  Gradient gradient_;              ///< G, columns with a pressure only
  std::vector<float> divergence_;  ///< D, of linear elements only; [block of the matrix][4], the fourth entry unused
  std::vector<double> scale_;

  // S: pressures couple over one ring of elements.
  struct Laplacian {
    std::array<std::int32_t, 6> nodes;  ///< whose mobility counts: corners (four), or those on the edges
    int count;
    bool wall;
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
  std::optional<WallCorrection> wall_;
  RankOneInverse velocity_outlets_, diagonal_outlets_;  ///< of K^ and of H
  std::vector<double> free_;   ///< [local node][4]: 1 where a component of the motion is not prescribed
  std::vector<double> yield_;  ///< [owned node]: what the resistance of an outlet leaves of a push at it [-]
  std::vector<float> sweep_;
  std::vector<double> z_, second_, pressure_rhs_;
  std::vector<double> halo_v_, halo_p_;
};

}  // namespace tunica::assembly
