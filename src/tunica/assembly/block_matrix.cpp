#include "tunica/assembly/block_matrix.hpp"

#include <algorithm>
#include <cstring>

#include "tunica/assembly/block_kernels.hpp"

namespace tunica::assembly {

BlockMatrix::BlockMatrix(const BlockPattern& p) : pattern(&p), blocks(static_cast<std::size_t>(p.blocks()) + 1) {
  set_zero();
}

void BlockMatrix::set_zero() { std::memset(static_cast<void*>(blocks.data()), 0, blocks.size() * sizeof(Block)); }

void BlockMatrix::multiply(Isa isa, std::span<const double> x, std::span<double> y) const {
  block_kernels(isa).multiply(pattern->rows, pattern->row_begin.data(), pattern->columns.data(), blocks.data()->a,
                              x.data(), y.data());
}

Constraints::Constraints(const BlockPattern& pattern, std::vector<NodeConstraint> constraints)
    : constraints_(std::move(constraints)) {
  std::vector<std::int32_t> of_node(pattern.columns_count, -1);
  for (std::size_t i = 0; i < constraints_.size(); ++i) of_node[constraints_[i].node] = static_cast<std::int32_t>(i);
  // Where all motions are free and no pressure is used, there is nothing to project; the diagonal alone needs an entry.
  const auto is_met = [&](std::int32_t node) {
    return of_node[node] < 0 ||
           (constraints_[of_node[node]].pressure_unused && trace(constraints_[of_node[node]].P) == 3);
  };
  for (std::int32_t row = 0; row < pattern.rows; ++row)
    for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
      const auto column = pattern.columns[b];
      const bool diagonal = row == column;
      const auto of_row = diagonal || !is_met(row) ? of_node[row] : -1,
                 of_column = is_met(column) ? -1 : of_node[column];
      if (of_row >= 0 || of_column >= 0) touched_.push_back({b, of_row, of_column, diagonal});
    }
}

namespace {

// What stands for the held directions of a node: 1, but the mean of the diagonal where they are oblique, since free and
// held share entries there and are added in single precision.
double held_entry(const NodeConstraint& c, const float* a) {
  const bool oblique = c.P(0, 1) != 0.0 || c.P(0, 2) != 0.0 || c.P(1, 2) != 0.0;
  const double mean = (static_cast<double>(a[0]) + a[5] + a[10]) / 3.0;
  return oblique && mean > 0 ? mean : 1.0;
}

}  // namespace

void Constraints::apply(BlockMatrix& matrix) const {
  for (const auto& t : touched_) {
    float* a = matrix.blocks[t.block].a;
    const double held = t.diagonal ? held_entry(constraints_[t.row], a) : 1.0;
    if (t.row >= 0) {
      const auto& c = constraints_[t.row];
      for (int j = 0; j < 4; ++j) {
        const double v[3] = {a[4 * j], a[4 * j + 1], a[4 * j + 2]};
        for (int i = 0; i < 3; ++i)
          a[4 * j + i] = static_cast<float>(c.P(i, 0) * v[0] + c.P(i, 1) * v[1] + c.P(i, 2) * v[2]);
        if (c.pressure_fixed) a[4 * j + 3] = 0;
      }
    }
    if (t.column >= 0) {
      const auto& c = constraints_[t.column];
      for (int i = 0; i < 4; ++i) {
        const double v[3] = {a[i], a[4 + i], a[8 + i]};
        for (int j = 0; j < 3; ++j)
          a[4 * j + i] = static_cast<float>(v[0] * c.P(0, j) + v[1] * c.P(1, j) + v[2] * c.P(2, j));
        if (c.pressure_fixed) a[12 + i] = 0;
      }
    }
    if (t.diagonal) {
      const auto& c = constraints_[t.row];
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) a[4 * j + i] += static_cast<float>(held * ((i == j ? 1.0 : 0.0) - c.P(i, j)));
      if (c.pressure_fixed) a[15] = 1;
    }
  }
}

void Constraints::apply(std::span<double> vector) const {
  for (const auto& c : constraints_) {
    double* r = vector.data() + 4 * static_cast<std::size_t>(c.node);
    const Vec3<double> p = c.P * Vec3<double>{{r[0], r[1], r[2]}};
    for (int i = 0; i < 3; ++i) r[i] = p[i];
    if (c.pressure_fixed) r[3] = 0;
  }
}

}  // namespace tunica::assembly
