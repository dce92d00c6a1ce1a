#include "tunica/mesh_io/quadratic_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::mesh_io {

namespace {

/// One ten-node tetrahedron behind a node that no cell has, with values at the nodes.
VtkCells one_cell() {
  VtkCells cells;
  cells.points = {{{9, 9, 9}}, {{0, 0, 0}}, {{2, 0, 0}}, {{0, 2, 0}}, {{0, 0, 2}}, {{1, 0, 0}},
                  {{1, 1, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{1, 0, 1}}, {{0, 1, 1}}};
  cells.types = {vtk_quadratic_tetrahedron};
  cells.offsets = {0, 10};
  cells.connectivity = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  cells.global_node_ids = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  cells.node_fields = {{"x", {9, 0, 2, 0, 0, 1, 1, 0, 0, 1, 0}}};
  return cells;
}

}  // namespace

TEST(KeepCorners, TakesTheNodesOfEdgesOut) {
  auto cells = one_cell();
  const auto found = keep_corners(cells);
  EXPECT_TRUE(found.any);
  EXPECT_EQ(found.bent, 0);
  EXPECT_EQ(cells.types, std::vector<int>{vtk_tetrahedron});
  EXPECT_EQ(cells.offsets, (std::vector<std::int64_t>{0, 4}));
  EXPECT_EQ(cells.connectivity, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(cells.points.size(), 5u);  // the one without a cell stays, for the reader to refuse
  EXPECT_EQ(cells.global_node_ids, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(cells.node_fields[0].values, (std::vector<double>{9, 0, 2, 0, 0}));
  EXPECT_EQ(describe(found, "a.vtu"), "");
}

TEST(KeepCorners, TellsOfBentEdges) {
  auto cells = one_cell();
  cells.points[6] = {{1.1, 1.1, 0}};
  const auto found = keep_corners(cells);
  EXPECT_EQ(found.bent, 1);
  EXPECT_NEAR(found.farthest, 0.05, 1e-12);  // 0.1 sqrt 2 of 2 sqrt 2
  EXPECT_NE(describe(found, "a.vtu").find("1 edges of its quadratic cells are bent"), std::string::npos);
}

TEST(KeepCorners, LeavesOtherCellsAlone) {
  auto cells = one_cell();
  cells.types = {vtk_tetrahedron};
  EXPECT_FALSE(keep_corners(cells).any);
  EXPECT_EQ(cells.points.size(), 11u);
}

}  // namespace tunica::mesh_io
