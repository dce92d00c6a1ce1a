#include "tunica/assembly/element_batches.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tunica/mesh/generate.hpp"

namespace tunica::assembly {
namespace {

struct Batches : testing::TestWithParam<int> {
  distributed::DistributedMesh mesh = distributed::distribute(mesh::tube({.radius = 1,
                                                                          .length = 2,
                                                                          .wall_thickness = 0.3,
                                                                          .cells_around = 8,
                                                                          .cells_radial = 1,
                                                                          .cells_along = 3,
                                                                          .cells_through_wall = 2}),
                                                              MPI_COMM_WORLD);
  BlockPattern pattern = make_pattern(mesh);
};

TEST_P(Batches, HoldEveryElementOnceInTheOrderOfTheRegion) {
  for (auto region : mesh.regions) {
    region.elements.pop_back();  // an odd number: the last batch of any width above one has spare lanes
    std::vector<std::int32_t> all;
    for (const bool split : {false, true}) {
      const auto batches = make_batches(mesh, region, pattern, GetParam(), split);
      EXPECT_TRUE(std::is_sorted(batches.elements_of_region.begin(), batches.elements_of_region.end()));
      all.insert(all.end(), batches.elements_of_region.begin(), batches.elements_of_region.end());
      std::int32_t lanes = 0;
      for (std::int32_t b = 0; b < batches.batches(); ++b) lanes += batches.lanes_used(b);
      EXPECT_EQ(lanes, batches.elements);
      for (const auto e : batches.elements_of_region)
        EXPECT_EQ(split, std::any_of(region.elements[e].begin(), region.elements[e].end(),
                                     [&](std::int32_t node) { return mesh.host[node] != node; }));
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all.size(), region.elements.size());
    for (std::size_t e = 0; e < all.size(); ++e) EXPECT_EQ(all[e], static_cast<std::int32_t>(e));
  }
}

TEST_P(Batches, LayOutNodesHostsAndSlotsByLane) {
  const int width = GetParam();
  for (const auto& region : mesh.regions)
    for (const bool split : {false, true}) {
      const auto batches = make_batches(mesh, region, pattern, width, split);
      const int kinds = split ? 4 : 1;
      for (std::int32_t batch = 0; batch < batches.batches(); ++batch)
        for (int lane = 0; lane < width; ++lane) {
          const auto e = std::min(batch * width + lane, batches.elements - 1);  // spare lanes repeat the last
          const auto& nodes = region.elements[batches.elements_of_region[e]];
          for (int a = 0; a < 4; ++a) {
            EXPECT_EQ(batches.nodes[(batch * 4 + a) * width + lane], nodes[a]);
            const auto host_a = mesh.host[nodes[a]];
            if (split) {
              EXPECT_EQ(batches.hosts[(batch * 4 + a) * width + lane], host_a);
            }
            for (int b = 0; b < 4; ++b) {
              const auto host_b = mesh.host[nodes[b]];
              const std::int32_t rows[4] = {host_a, host_a, nodes[a], nodes[a]};
              const std::int32_t columns[4] = {host_b, nodes[b], host_b, nodes[b]};
              for (int kind = 0; kind < kinds; ++kind)
                EXPECT_EQ(batches.slots[((batch * kinds + kind) * 16 + 4 * a + b) * width + lane],
                          pattern.slot(rows[kind], columns[kind]));
            }
          }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Widths, Batches, testing::Values(1, 2, 4, 8));

}  // namespace
}  // namespace tunica::assembly
