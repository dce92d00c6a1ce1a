#include "tunica/mesh/ordering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tunica/base/error.hpp"
#include "tunica/distributed/partition.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::distributed {
namespace {

mesh::Graph path(const std::vector<std::int32_t>& vertices) {
  std::vector<std::vector<std::int32_t>> rows(vertices.size());
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    rows[vertices[i]].push_back(vertices[i - 1]);
    rows[vertices[i - 1]].push_back(vertices[i]);
  }
  mesh::Graph graph;
  graph.begin.push_back(0);
  for (const auto& row : rows) {
    graph.neighbours.insert(graph.neighbours.end(), row.begin(), row.end());
    graph.begin.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

std::int32_t bandwidth(const mesh::Graph& graph, const std::vector<std::int32_t>& order) {
  std::vector<std::int32_t> position(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<std::int32_t>(i);
  std::int32_t widest = 0;
  for (std::int32_t v = 0; v < graph.size(); ++v)
    for (const std::int32_t w : graph.of(v)) widest = std::max(widest, std::abs(position[v] - position[w]));
  return widest;
}

std::vector<std::array<std::int32_t, 4>> narrow(const mesh::MeshData& data) {
  std::vector<std::array<std::int32_t, 4>> elements;
  for (const auto& t : data.tetrahedra)
    elements.push_back({static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
                        static_cast<std::int32_t>(t[2]), static_cast<std::int32_t>(t[3])});
  return elements;
}

TEST(Ordering, GraphHoldsEachNeighbourOnce) {
  const std::vector<std::array<std::int32_t, 4>> elements{{0, 1, 2, 3}, {1, 2, 3, 4}};
  const mesh::Graph graph = mesh::graph_of_elements(6, elements);
  const auto row = [&](std::int32_t v) {
    std::vector<std::int32_t> neighbours(graph.of(v).begin(), graph.of(v).end());
    std::sort(neighbours.begin(), neighbours.end());
    return neighbours;
  };
  EXPECT_EQ(row(0), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(row(2), (std::vector<std::int32_t>{0, 1, 3, 4}));
  EXPECT_EQ(row(4), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_TRUE(row(5).empty());
}

TEST(Ordering, FindsTheEndsOfAShuffledPath) {
  std::vector<std::int32_t> vertices(100);
  std::iota(vertices.begin(), vertices.end(), 0);
  std::shuffle(vertices.begin(), vertices.end(), std::mt19937(3));
  const mesh::Graph graph = path(vertices);
  const std::vector<std::int32_t> part(vertices.size(), 0);
  EXPECT_EQ(bandwidth(graph, mesh::reverse_cuthill_mckee(graph, part, 1)), 1);
}

TEST(Ordering, OfALongBoxIsAsNarrowAsItsCrossSection) {
  const mesh::MeshData data = mesh::box(2, 2, 40, {{1, 1, 20}}, mesh::RegionKind::lumen);
  const auto nodes = static_cast<std::int32_t>(data.points.size());
  const mesh::Graph graph = mesh::graph_of_elements(nodes, narrow(data));
  const std::vector<std::int32_t> part(data.points.size(), 0);
  const auto order = mesh::reverse_cuthill_mckee(graph, part, 1);
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(),
                                  [&] {
                                    std::vector<std::int32_t> all(data.points.size());
                                    std::iota(all.begin(), all.end(), 0);
                                    return all;
                                  }()
                                      .begin()));
  EXPECT_LE(bandwidth(graph, order), 2 * 9);  // nine nodes in a cross-section
}

TEST(Ordering, KeepsPartsTogetherAndIsolatedVertices) {
  const mesh::Graph graph =
      mesh::graph_of_elements(7, std::vector<std::array<std::int32_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}});
  const std::vector<std::int32_t> part{1, 0, 1, 0, 0, 1, 0};
  const auto order = mesh::reverse_cuthill_mckee(graph, part, 2);
  ASSERT_EQ(order.size(), part.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(part[order[i]], i < 4 ? 0 : 1);
}

TEST(Partition, BalancesTheWeightsNotTheNodes) {
  const mesh::MeshData data = mesh::box(6, 6, 12, {{1, 1, 2}}, mesh::RegionKind::lumen);
  const auto nodes = static_cast<std::int32_t>(data.points.size());
  std::vector<std::int32_t> weights;
  for (const auto& point : data.points) weights.push_back(point[2] > 1 ? 10 : 1);
  const auto part = partition(mesh::graph_of_elements(nodes, narrow(data)), weights, 4);
  std::vector<double> sums(4, 0);
  for (std::int32_t v = 0; v < nodes; ++v) sums[part[v]] += weights[v];
  const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / 4;
  for (const double sum : sums) EXPECT_NEAR(sum, mean, 0.05 * mean);
}

TEST(Partition, RefusesMoreRanksThanNodes) {
  const mesh::Graph graph = mesh::graph_of_elements(4, std::vector<std::array<std::int32_t, 4>>{{0, 1, 2, 3}});
  EXPECT_THROW(partition(graph, std::vector<std::int32_t>(4, 1), 5), InputError);
}

}  // namespace
}  // namespace tunica::distributed
