// Parts of the wall that stresses are told for.
#include "tunica/analysis/wall_parts.hpp"

#include <gtest/gtest.h>

namespace tunica::analysis {
namespace {

/// Ten elements of lumen, ten of `wall` and ten of `flap`, their depths 0.05, 0.15, ... 0.95.
mesh::MeshData strips() {
  mesh::MeshData data;
  data.tetrahedra.assign(30, {0, 1, 2, 3});
  data.regions = {{"lumen", mesh::RegionKind::lumen, 0, 10},
                  {"wall", mesh::RegionKind::wall, 10, 20},
                  {"flap", mesh::RegionKind::wall, 20, 30}};
  mesh::ElementField depth{"depth", 1, {}};
  for (int e = 0; e < 30; ++e) depth.values.push_back(0.05 + 0.1 * (e % 10));
  data.fields.push_back(depth);
  return data;
}

RunDescription wall_alone() {
  RunDescription run;
  run.wall = true;
  return run;
}

std::vector<std::pair<std::string, std::size_t>> sizes(const std::vector<WallPart>& parts) {
  std::vector<std::pair<std::string, std::size_t>> result;
  for (const auto& part : parts) result.emplace_back(part.name, part.elements.size());
  return result;
}

using Sizes = std::vector<std::pair<std::string, std::size_t>>;

TEST(WallParts, AreTheRegionsWhereThereAreNoLayers) {
  EXPECT_EQ(sizes(wall_parts(wall_alone(), strips())), (Sizes{{"wall", 10}, {"flap", 10}}));
}

TEST(WallParts, LayersFollowTheirRegion) {
  auto run = wall_alone();
  run.layers = LayerBorders{"depth", {0.2, 0.7}};
  run.layers_of_region["flap"] = std::nullopt;
  const auto parts = wall_parts(run, strips());
  EXPECT_EQ(sizes(parts),
            (Sizes{{"wall", 10}, {"wall layer 1", 2}, {"wall layer 2", 5}, {"wall layer 3", 3}, {"flap", 10}}));
  EXPECT_EQ(parts[1].elements, (std::vector<std::int64_t>{10, 11}));
  EXPECT_EQ(run.depths(), std::vector<std::string>{"depth"});
}

TEST(WallParts, DepthsAtCornersCountByTheirMean) {
  auto data = strips();
  auto& depth = data.fields[0];
  std::vector<double> corners;
  for (const double d : depth.values)
    for (const double off : {-0.04, 0.04, -0.02, 0.02}) corners.push_back(d + off);
  depth = {"depth", 4, corners};
  auto run = wall_alone();
  run.layers = LayerBorders{"depth", {0.2, 0.7}};
  run.layers_of_region["flap"] = std::nullopt;
  EXPECT_EQ(sizes(wall_parts(run, data)),
            (Sizes{{"wall", 10}, {"wall layer 1", 2}, {"wall layer 2", 5}, {"wall layer 3", 3}, {"flap", 10}}));
}

TEST(WallParts, LayersWithoutElementsAreLeftOut) {
  auto run = wall_alone();
  run.layers_of_region["flap"] = LayerBorders{"depth", {0.0, 0.5}};
  EXPECT_EQ(sizes(wall_parts(run, strips())),
            (Sizes{{"wall", 10}, {"flap", 10}, {"flap layer 2", 5}, {"flap layer 3", 5}}));
}

TEST(WallParts, LayersOfAMeshWithoutDepthsAreLeftOut) {
  auto data = strips();
  data.fields.clear();
  auto run = wall_alone();
  run.layers = LayerBorders{"depth", {0.5}};
  EXPECT_EQ(sizes(wall_parts(run, data)), (Sizes{{"wall", 10}, {"flap", 10}}));
}

}  // namespace
}  // namespace tunica::analysis
