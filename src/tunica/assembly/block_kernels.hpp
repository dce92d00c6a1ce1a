// Loops over blocks that are compiled once per instruction set. Plain pointers only: nothing from the standard library
// may be instantiated in the translation units of the wider sets.
#pragma once

#include <cstdint>

#include "tunica/assembly/isa.hpp"

namespace tunica::assembly {

/// Incomplete factors of the velocity block, single precision, 3 x 4 floats per block: column by column, each column
/// padded to four. Only columns of owned nodes take part. Lower and upper blocks stand apart, so that each sweep of a
/// solve streams through just the half that it needs; and once found they are rounded to two bytes, since a sweep takes
/// as long as reading them does.
struct IluFactors {
  struct Triangle {
    const std::int32_t* row_begin = nullptr;  ///< rows + 1
    const std::int32_t* columns = nullptr;    ///< ascending in each row, without the diagonal
    float* blocks = nullptr;                  ///< 12 floats each; once rounded, 12 numbers of two bytes from the front
  };
  std::int32_t rows = 0;
  Triangle lower, upper;
  float* inverse_diagonal = nullptr;  ///< 12 floats per row
};

struct BlockKernels {
  /// y = A x for 4 x 4 single-precision blocks, x and y double.
  void (*multiply)(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns, const float* blocks,
                   const double* x, double* y);
  /// The same for 3 x 3 blocks with padded columns (12 floats); x and y keep stride 4, the fourth entry of y is 0.
  void (*multiply3)(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns, const float* blocks,
                    const double* x, double* y);
  /// y_i = sum over row i of d . x, for 1 x 3 blocks d (4 floats, the fourth 0); x: [column][4].
  void (*multiply_rows)(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns,
                        const float* blocks, const double* x, double* y);
  /// y = sum over row i of g x, for 3 x 1 blocks g (4 floats, the fourth 0); x: [column], y: [row][4].
  void (*multiply_columns)(std::int32_t rows, const std::int32_t* row_begin, const std::int32_t* columns,
                           const float* blocks, const double* x, double* y);
  /// Rounds the off-diagonal blocks in place to the upper half of a float (8 bits of mantissa, its range kept).
  void (*ilu_round)(const IluFactors& factors);
  /// x = (L D U)^-1 x of rounded factors, x: [row][4] single precision, the fourth entry unused.
  void (*ilu_solve)(const IluFactors& factors, float* x);
  /// Computes the factors in place; `position` is scratch of `rows` integers, all -1 on entry and exit.
  /// Returns the row of the first singular diagonal block, or -1.
  std::int32_t (*ilu_factorise)(const IluFactors& factors, std::int32_t* position);
};

/// Instantiated in block_kernels_<isa>.cpp.
template <int W>
BlockKernels make_block_kernels();

const BlockKernels& block_kernels(Isa isa);

}  // namespace tunica::assembly
