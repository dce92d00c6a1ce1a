#include "tunica/assembly/block_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "numbers.hpp"

namespace tunica::assembly {
namespace {

using test::noise;

// A block matrix with its factors; blocks couple rows at the distances of `bands` (0 is always there).
struct Factorisable {
  struct Triangle {
    std::vector<std::int32_t> row_begin{0}, columns;
    std::vector<float> blocks;
    IluFactors::Triangle view() { return {row_begin.data(), columns.data(), blocks.data()}; }
  };
  std::int32_t rows;
  Triangle lower, upper;
  std::vector<std::int32_t> position;
  std::vector<float> diagonal;
  std::vector<double> dense;  // row-major, 3 rows x 3 rows

  Factorisable(std::int32_t n, const std::set<std::int32_t>& bands)
      : rows(n), position(static_cast<std::size_t>(n), -1), dense(9 * static_cast<std::size_t>(n) * n, 0.0) {
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t j = 0; j < n; ++j) {
        if (j == i) add_block(i, j, diagonal);
        if (j == i || !bands.contains(std::abs(i - j))) continue;
        Triangle& triangle = j < i ? lower : upper;
        triangle.columns.push_back(j);
        add_block(i, j, triangle.blocks);
      }
      for (auto* triangle : {&lower, &upper})
        triangle->row_begin.push_back(static_cast<std::int32_t>(triangle->columns.size()));
    }
  }
  void add_block(std::int32_t row, std::int32_t column, std::vector<float>& to) {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        if (i == 3) {
          to.push_back(0.0F);
          continue;
        }
        const auto value =
            static_cast<float>(noise(row * 97 + column, 4 * i + j) + (row == column && i == j ? 6.0 : 0.0));
        to.push_back(value);
        dense[(3 * static_cast<std::size_t>(row) + i) * 3 * rows + 3 * column + j] = value;
      }
  }
  IluFactors factors() { return {rows, lower.view(), upper.view(), diagonal.data()}; }
};

// Gaussian elimination without pivoting, enough for dominant diagonals.
std::vector<double> dense_solve(std::vector<double> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
  return b;
}

std::vector<float> padded_rhs(std::int32_t rows) {
  std::vector<float> x(test::at(rows), 0.0F);
  for (std::int32_t i = 0; i < rows; ++i)
    for (int c = 0; c < 3; ++c) x[test::at(i) + c] = static_cast<float>(noise(i, c));
  return x;
}

TEST(BlockKernels, IncompleteFactorsOfABlockTridiagonalMatrixAreExact) {
  constexpr std::int32_t n = 13;
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(name(isa));
    Factorisable matrix(n, {1});
    EXPECT_EQ(block_kernels(isa).ilu_factorise(matrix.factors(), matrix.position.data()), -1);
    EXPECT_EQ(matrix.position, std::vector<std::int32_t>(n, -1));
    auto x = padded_rhs(n);
    std::vector<double> rhs;
    for (std::int32_t i = 0; i < n; ++i) rhs.insert(rhs.end(), x.begin() + 4 * i, x.begin() + 4 * i + 3);
    block_kernels(isa).ilu_round(matrix.factors());
    block_kernels(isa).ilu_solve(matrix.factors(), x.data());
    const auto exact = dense_solve(matrix.dense, rhs);
    for (std::int32_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[test::at(i) + c], exact[3 * i + c], 1e-3);  // eight bits of 0.2
  }
}

// With fill-in dropped, the product of the factors still agrees with the matrix wherever that has blocks (Saad 2003,
// proposition 10.4). L has unit diagonal, `diagonal` holds the inverses of D.
TEST(BlockKernels, ProductOfIncompleteFactorsAgreesOnThePattern) {
  constexpr std::int32_t n = 12;
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(name(isa));
    Factorisable matrix(n, {1, 4});
    EXPECT_EQ(block_kernels(isa).ilu_factorise(matrix.factors(), matrix.position.data()), -1);
    constexpr std::size_t m = 3 * n;
    std::vector<double> lower(m * m, 0.0), upper(m * m, 0.0);
    const auto put = [&](std::vector<double>& to, std::int32_t row, std::int32_t column, const float* block) {
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) to[(3 * row + i) * m + 3 * column + j] = block[4 * j + i];
    };
    std::set<std::pair<std::int32_t, std::int32_t>> pattern;
    for (std::int32_t i = 0; i < n; ++i) {
      pattern.insert({i, i});
      for (const auto& [triangle, to] : {std::pair{&matrix.lower, &lower}, {&matrix.upper, &upper}})
        for (auto b = triangle->row_begin[i]; b < triangle->row_begin[i + 1]; ++b) {
          put(*to, i, triangle->columns[b], triangle->blocks.data() + 12 * static_cast<std::size_t>(b));
          pattern.insert({i, triangle->columns[b]});
        }
      // D from its inverse, column by column.
      std::vector<double> inverse(9);
      for (int j = 0; j < 3; ++j)
        for (int c = 0; c < 3; ++c) inverse[3 * c + j] = matrix.diagonal[12 * static_cast<std::size_t>(i) + 4 * j + c];
      for (int j = 0; j < 3; ++j) {
        std::vector<double> unit(3, 0.0);
        unit[j] = 1;
        const auto column = dense_solve(inverse, unit);
        for (int c = 0; c < 3; ++c) upper[(3 * i + c) * m + 3 * i + j] = column[c];
      }
      for (int c = 0; c < 3; ++c) lower[(3 * i + c) * m + 3 * i + c] = 1;
    }
    for (const auto& [row, column] : pattern)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double sum = 0;
          for (std::size_t k = 0; k < m; ++k) sum += lower[(3 * row + i) * m + k] * upper[k * m + 3 * column + j];
          EXPECT_NEAR(sum, matrix.dense[(3 * row + i) * m + 3 * column + j], 1e-5) << row << ", " << column;
        }
  }
}

// The upper half of a float: sign, exponent and seven bits of the mantissa after the leading one.
TEST(BlockKernels, RoundedFactorsAreTheNearestOfEightBits) {
  constexpr std::int32_t n = 12;
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(name(isa));
    Factorisable matrix(n, {1, 4});
    ASSERT_EQ(block_kernels(isa).ilu_factorise(matrix.factors(), matrix.position.data()), -1);
    for (auto* triangle : {&matrix.lower, &matrix.upper}) {
      const std::vector<float> before = triangle->blocks;
      std::vector<std::int32_t> empty(n + 1, 0);
      const IluFactors::Triangle left_alone{empty.data(), nullptr, nullptr};
      block_kernels(isa).ilu_round({n, triangle->view(), left_alone, matrix.diagonal.data()});
      for (std::size_t k = 0; k < before.size(); ++k) {
        std::uint16_t half = 0;
        std::memcpy(&half, reinterpret_cast<const unsigned char*>(triangle->blocks.data()) + 2 * k, sizeof half);
        const auto bits = static_cast<std::uint32_t>(half) << 16;
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        EXPECT_NEAR(value, before[k], std::abs(before[k]) / 256) << k;
      }
    }
  }
}

TEST(BlockKernels, NamesTheRowOfASingularDiagonalAndCleansUp) {
  constexpr std::int32_t n = 9, bad = 4;
  for (const auto isa : test::available_isas())
    for (const float value : {0.0F, NAN}) {
      SCOPED_TRACE(name(isa));
      Factorisable matrix(n, {1});
      for (int k = 0; k < 12; ++k) matrix.diagonal[12 * bad + k] = value;
      for (auto b = matrix.lower.row_begin[bad]; b < matrix.lower.row_begin[bad + 1]; ++b)
        for (int k = 0; k < 12; ++k) matrix.lower.blocks[12 * static_cast<std::size_t>(b) + k] = 0.0F;
      EXPECT_EQ(block_kernels(isa).ilu_factorise(matrix.factors(), matrix.position.data()), bad);
      EXPECT_EQ(matrix.position, std::vector<std::int32_t>(n, -1)) << "the next factorisation would read these";
    }
}

}  // namespace
}  // namespace tunica::assembly
