#include "tunica/assembly/block_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numbers.hpp"
#include "tunica/assembly/block_kernels.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::assembly {
namespace {

using test::at;
using test::block_entry;
using test::noise;

distributed::DistributedMesh small_mesh() {
  return distributed::distribute(mesh::tube({.radius = 1,
                                             .length = 2,
                                             .wall_thickness = 0.3,
                                             .cells_around = 8,
                                             .cells_radial = 1,
                                             .cells_along = 3,
                                             .cells_through_wall = 1}),
                                 MPI_COMM_WORLD);
}

double entry(const distributed::DistributedMesh& mesh, std::int32_t row, std::int32_t column, int i, int j) {
  return block_entry(mesh.original_ids[row], mesh.original_ids[column], i, j);
}

BlockMatrix filled(const distributed::DistributedMesh& mesh, const BlockPattern& pattern) {
  BlockMatrix matrix(pattern);
  for (std::int32_t row = 0; row < pattern.rows; ++row)
    for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          matrix.blocks[b].a[4 * j + i] = static_cast<float>(entry(mesh, row, pattern.columns[b], i, j));
  return matrix;
}

// A vector whose ghosts came through the halo.
std::vector<double> vector_with_ghosts(const distributed::DistributedMesh& mesh) {
  std::vector<double> x(at(mesh.nodes()), 0.0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    for (int c = 0; c < 4; ++c) x[at(i) + c] = noise(mesh.original_ids[i], c);
  mesh.halo.update(x, 4);
  return x;
}

TEST(BlockMatrix, ProductEqualsTheSumOverEntries) {
  const auto mesh = small_mesh();
  const auto pattern = make_pattern(mesh);
  const auto matrix = filled(mesh, pattern);
  const auto x = vector_with_ghosts(mesh);
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(name(isa));
    std::vector<double> y(at(pattern.rows), NAN);
    matrix.multiply(isa, x, y);
    for (std::int32_t row = 0; row < pattern.rows; ++row)
      for (int i = 0; i < 4; ++i) {
        double sum = 0;
        for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
          const auto column = pattern.columns[b];
          for (int j = 0; j < 4; ++j) sum += entry(mesh, row, column, i, j) * noise(mesh.original_ids[column], j);
        }
        EXPECT_NEAR(y[at(row) + i], sum, 1e-13);
      }
  }
}

TEST(BlockMatrix, ProductOfThreeByThreeBlocksLeavesTheFourthEntryZero) {
  const auto mesh = small_mesh();
  const auto pattern = make_pattern(mesh);
  const auto x = vector_with_ghosts(mesh);
  std::vector<float> blocks(12 * static_cast<std::size_t>(pattern.blocks()), 0.0F);
  for (std::int32_t row = 0; row < pattern.rows; ++row)
    for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          blocks[12 * static_cast<std::size_t>(b) + 4 * j + i] =
              static_cast<float>(entry(mesh, row, pattern.columns[b], i, j));
  for (const auto isa : test::available_isas()) {
    SCOPED_TRACE(name(isa));
    std::vector<double> y(at(pattern.rows), NAN);
    block_kernels(isa).multiply3(pattern.rows, pattern.row_begin.data(), pattern.columns.data(), blocks.data(),
                                 x.data(), y.data());
    for (std::int32_t row = 0; row < pattern.rows; ++row) {
      for (int i = 0; i < 3; ++i) {
        double sum = 0;
        for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
          const auto column = pattern.columns[b];
          for (int j = 0; j < 3; ++j) sum += entry(mesh, row, column, i, j) * noise(mesh.original_ids[column], j);
        }
        EXPECT_NEAR(y[at(row) + i], sum, 1e-13);
      }
      EXPECT_EQ(y[at(row) + 3], 0.0);
    }
  }
}

// Free, sliding on an oblique plane, sliding along an oblique line, fixed, and with or without pressure.
NodeConstraint constraint_of(const distributed::DistributedMesh& mesh, std::int32_t node) {
  const auto id = mesh.original_ids[node];
  NodeConstraint c{node, identity<double>(), id % 5 == 0};
  if (id % 4 == 0) return c;
  Vec3<double> n{{noise(id, 40), noise(id, 41), noise(id, 42)}};
  n = (1.0 / norm(n)) * n;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c.P(i, j) = id % 4 == 1 ? (i == j ? 1.0 : 0.0) - n[i] * n[j] : id % 4 == 2 ? n[i] * n[j] : 0.0;
  return c;
}

struct Projector4 {
  double t[4][4] = {};
  explicit Projector4(const NodeConstraint& c) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) t[i][j] = c.P(i, j);
    t[3][3] = c.pressure_fixed ? 0.0 : 1.0;
  }
};

std::vector<NodeConstraint> constraints_of(const distributed::DistributedMesh& mesh) {
  std::vector<NodeConstraint> list;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    if (mesh.original_ids[i] % 3 != 0) list.push_back(constraint_of(mesh, i));
  return list;
}

Projector4 projector_of(const distributed::DistributedMesh& mesh, std::int32_t node) {
  if (mesh.original_ids[node] % 3 != 0) return Projector4(constraint_of(mesh, node));
  return Projector4({node, identity<double>(), false});
}

// What stands on the diagonal for the held directions of velocity: the mean of the free block, or 1 where nothing is
// free.
double held_entry(const distributed::DistributedMesh& mesh, std::int32_t row, const Projector4& p) {
  const double mean = (entry(mesh, row, row, 0, 0) + entry(mesh, row, row, 1, 1) + entry(mesh, row, row, 2, 2)) / 3.0;
  const bool oblique = p.t[0][1] != 0.0 || p.t[0][2] != 0.0 || p.t[1][2] != 0.0;
  return oblique && mean > 0 ? mean : 1.0;
}

TEST(Constraints, ProjectTheMatrixFromBothSides) {
  const auto mesh = small_mesh();
  const auto pattern = make_pattern(mesh);
  auto matrix = filled(mesh, pattern);
  Constraints(pattern, constraints_of(mesh)).apply(matrix);
  for (std::int32_t row = 0; row < pattern.rows; ++row)
    for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b) {
      const auto column = pattern.columns[b];
      const Projector4 left = projector_of(mesh, row), right = projector_of(mesh, column);
      const double held = held_entry(mesh, row, left);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          double expected = row == column ? (i < 3 ? held : 1.0) * ((i == j ? 1.0 : 0.0) - left.t[i][j]) : 0.0;
          for (int k = 0; k < 4; ++k)
            for (int l = 0; l < 4; ++l) expected += left.t[i][k] * entry(mesh, row, column, k, l) * right.t[l][j];
          EXPECT_NEAR(matrix.blocks[b].a[4 * j + i], expected, 1e-6)
              << "nodes " << row << ", " << column << (column < pattern.rows ? "" : " (ghost)");
        }
    }
}

TEST(Constraints, ProjectVectorsOnOwnedAndGhostNodes) {
  const auto mesh = small_mesh();
  const auto pattern = make_pattern(mesh);
  const auto x = vector_with_ghosts(mesh);
  auto projected = x;
  Constraints(pattern, constraints_of(mesh)).apply(projected);
  for (std::int32_t node = 0; node < mesh.nodes(); ++node) {
    const Projector4 p = projector_of(mesh, node);
    for (int i = 0; i < 4; ++i) {
      double expected = 0;
      for (int j = 0; j < 4; ++j) expected += p.t[i][j] * x[at(node) + j];
      EXPECT_NEAR(projected[at(node) + i], expected, 1e-14);
    }
  }
}

}  // namespace
}  // namespace tunica::assembly
