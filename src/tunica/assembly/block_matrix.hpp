// The tangent: 4 x 4 blocks over node pairs, filled in place through slots and multiplied without PETSc.
//
// Entries are stored in single precision: the tangent only steers Newton's method, whose residual is in double, and the
// product with a vector is limited by the bytes it moves (docs/performance.md has the figures). Sums run in double.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/assembly/block_pattern.hpp"
#include "tunica/assembly/isa.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::assembly {

/// Which motions of a node are free: increments and residuals are projected with `P`.
struct NodeConstraint {
  std::int32_t node;             ///< local, owned or ghost
  Mat3<double> P;                ///< symmetric projector on the free directions: 0 fixed, I - n n^T sliding
  bool pressure_fixed;           ///< the node has no pressure of its own
  bool pressure_unused = false;  ///< and no element adds to its rows and columns, as on the edges of quadratic elements
};

struct BlockMatrix {
  /// One block, column by column: entry (row r, column c) is a[4 c + r].
  struct alignas(64) Block {
    float a[16];
  };

  const BlockPattern* pattern = nullptr;
  std::vector<Block> blocks;  ///< one more than the pattern: contributions to ghost rows end there

  explicit BlockMatrix(const BlockPattern& p);
  void set_zero();
  /// y = A x. `x`: [local node][4] with up-to-date ghosts, `y`: [owned node][4].
  void multiply(Isa isa, std::span<const double> x, std::span<double> y) const;
};

/// Keeps constraints and the blocks that they touch.
class Constraints {
 public:
  Constraints() = default;
  Constraints(const BlockPattern& pattern, std::vector<NodeConstraint> constraints);

  /// A <- T A T + s (I - T), T the block-diagonal projector; s is the mean of the diagonal of the node's block where
  /// its plane or line is oblique to the axes, else 1.
  void apply(BlockMatrix& matrix) const;
  /// r <- T r, [local node][4].
  void apply(std::span<double> vector) const;
  const std::vector<NodeConstraint>& list() const { return constraints_; }

 private:
  struct Touched {
    std::int32_t block, row, column;  ///< row, column: index of the constraint on that side, or -1
    bool diagonal;
  };
  std::vector<NodeConstraint> constraints_;
  std::vector<Touched> touched_;
};

}  // namespace tunica::assembly
