// Coarse correction of the velocity block where it is a wall: smooth motions are stiff against their inertia, and
// incomplete factors, which see one ring of elements, take as many iterations as the wall has elements along it.
//
//   K^-1 ~ P A^-1 P^T + (factors of K)^-1,   A = P^T K P,
//
// P: motions that are linear in each element of the wall, given at its corners, 0 at nodes of the lumen alone and where
// a component is prescribed. With linear elements P is the identity on the wall. A^-1: one cycle of smoothed
// aggregation that knows the rigid motions (Vanek, Mandel & Brezina 1996, doi:10.1007/BF02238511). Both parts stand
// beside each other: one after the other saves a seventh of the iterations and costs a product with K in each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/assembly/block_matrix.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/parallel/petsc.hpp"

namespace tunica::assembly {

class WallCorrection {
 public:
  /// The mesh has a wall. Collective.
  WallCorrection(const distributed::DistributedMesh& mesh, const BlockPattern& pattern);

  /// Coarse matrix and multigrid of `matrix`. `free`: [local node][4], 1 where a component is not prescribed.
  /// Collective.
  void update(const BlockMatrix& matrix, std::span<const double> free);

  /// x = P A^-1 P^T r, both [owned node][4] and perhaps the same; the fourth entries of x are 0. Collective.
  void apply(std::span<const double> r, std::span<double> x);

 private:
  /// Corners whose motion a node follows, each with the weight 1/count; none outside the wall.
  struct Parents {
    std::int32_t corner[2];  ///< local coarse number
    int count = 0;
  };
  void number_corners();
  void make_pattern();
  void make_matrix();
  void accumulate(const BlockMatrix& matrix);
  void leave_out_prescribed();

  const distributed::DistributedMesh& mesh_;
  const BlockPattern& pattern_;
  std::vector<Parents> parents_;           ///< [local node]
  std::vector<std::int32_t> corner_node_;  ///< [local coarse number] local node
  std::vector<std::int64_t> corner_id_;    ///< [local coarse number] global coarse number
  std::int32_t owned_corners_ = 0;
  std::vector<double> free_;  ///< [local node][4]: 1 where the component is free

  std::vector<std::int32_t> row_begin_, columns_;  ///< local coarse blocks
  std::vector<double> values_;                     ///< [block][9], row by row
  std::vector<double> coarse_row_;                 ///< scratch, [local coarse number][9]
  parallel::MatHandle matrix_;
  parallel::PcHandle multigrid_;
  parallel::VecHandle rhs_, solution_;
  std::vector<double> halo_;
};

}  // namespace tunica::assembly
