#include "tunica/assembly/block_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tunica/mesh/generate.hpp"

namespace tunica::assembly {
namespace {

using Neighbours = std::vector<std::set<std::int64_t>>;  // by position in MeshData::points

mesh::MeshData small_tube() {
  return mesh::tube({.radius = 1,
                     .length = 2,
                     .wall_thickness = 0.3,
                     .cells_around = 8,
                     .cells_radial = 1,
                     .cells_along = 3,
                     .cells_through_wall = 2});
}

std::vector<std::int64_t> hosts(const mesh::MeshData& data) {
  std::vector<std::int64_t> host(data.points.size());
  for (std::size_t i = 0; i < host.size(); ++i) host[i] = static_cast<std::int64_t>(i);
  for (const auto& [wall, lumen] : data.twins) host[static_cast<std::size_t>(wall)] = lumen;
  return host;
}

Neighbours with_diagonal(const mesh::MeshData& data) {
  Neighbours result(data.points.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i].insert(static_cast<std::int64_t>(i));
  return result;
}

// Couples all nodes of an element and, if asked, their hosts, element by element.
Neighbours coupled(const mesh::MeshData& data, bool with_hosts, bool lumen, bool wall) {
  const auto host = hosts(data);
  Neighbours result = with_diagonal(data);
  for (const auto& region : data.regions) {
    if (!(region.kind == mesh::RegionKind::lumen ? lumen : wall)) continue;
    for (auto e = region.first_element; e < region.end_element; ++e) {
      std::set<std::int64_t> nodes;
      for (const auto node : data.tetrahedra[static_cast<std::size_t>(e)]) {
        nodes.insert(node);
        if (with_hosts) nodes.insert(host[static_cast<std::size_t>(node)]);
      }
      for (const auto a : nodes) result[static_cast<std::size_t>(a)].insert(nodes.begin(), nodes.end());
    }
  }
  return result;
}

void expect_rows(const distributed::DistributedMesh& mesh, const BlockPattern& pattern, const Neighbours& expected) {
  ASSERT_EQ(pattern.rows, mesh.owned_nodes);
  EXPECT_EQ(pattern.columns_count, mesh.nodes());
  for (std::int32_t i = 0; i < pattern.rows; ++i) {
    const auto first = pattern.columns.begin() + pattern.row_begin[i],
               last = pattern.columns.begin() + pattern.row_begin[i + 1];
    EXPECT_TRUE(std::is_sorted(first, last));
    std::set<std::int64_t> found;
    for (auto it = first; it != last; ++it) found.insert(mesh.original_ids[*it]);
    EXPECT_EQ(found.size(), static_cast<std::size_t>(last - first)) << "a column twice in row " << i;
    EXPECT_EQ(found, expected[static_cast<std::size_t>(mesh.original_ids[i])]) << "row " << i;
    EXPECT_EQ(pattern.columns[pattern.diagonal[i]], i);
  }
}

TEST(BlockPattern, CouplesTheNodesOfAnElementAndTheirHosts) {
  const auto data = small_tube();
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  expect_rows(mesh, make_pattern(mesh), coupled(data, true, true, true));
}

TEST(BlockPattern, OfOneKindKeepsOnlyDiagonalsElsewhere) {
  const auto data = small_tube();
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  expect_rows(mesh, make_pattern(mesh, mesh::RegionKind::lumen), coupled(data, true, true, false));
  expect_rows(mesh, make_pattern(mesh, mesh::RegionKind::wall), coupled(data, true, false, true));
}

TEST(BlockPattern, OfPressuresCouplesElementsAndTwinWithHost) {
  const auto data = small_tube();
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  auto expected = coupled(data, false, true, true);
  for (const auto& [wall, lumen] : data.twins) {
    expected[static_cast<std::size_t>(wall)].insert(lumen);
    expected[static_cast<std::size_t>(lumen)].insert(wall);
  }
  expect_rows(mesh, make_pressure_pattern(mesh), expected);
}

TEST(BlockPattern, SlotsFindTheirBlockAndGhostRowsEndBehindTheLast) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_WORLD);
  const auto pattern = make_pattern(mesh);
  for (std::int32_t i = 0; i < pattern.rows; ++i)
    for (auto b = pattern.row_begin[i]; b < pattern.row_begin[i + 1]; ++b)
      EXPECT_EQ(pattern.slot(i, pattern.columns[b]), b);
  for (std::int32_t ghost = mesh.owned_nodes; ghost < mesh.nodes(); ++ghost)
    EXPECT_EQ(pattern.slot(ghost, 0), pattern.blocks());
}

}  // namespace
}  // namespace tunica::assembly
