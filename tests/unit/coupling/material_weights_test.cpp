#include "tunica/coupling/material_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::coupling {
namespace {

/// A row of elements, depth from 0 to 1 along x, share 0.25.
distributed::DistributedMesh bar(double share) {
  auto data = mesh::box(8, 1, 1, {{1.0, 0.1, 0.1}}, mesh::RegionKind::wall);
  mesh::ElementField depth{"depth", 1, {}};
  for (const auto& t : data.tetrahedra) {
    double x = 0;
    for (const auto n : t) x += 0.25 * data.points[static_cast<std::size_t>(n)][0];
    depth.values.push_back(x);
  }
  data.fields = {depth, {"share", 1, std::vector<double>(data.tetrahedra.size(), share)}};
  return distributed::distribute(data, MPI_COMM_WORLD);
}

wall::Composition layered() {
  wall::Composition composition;
  composition.layers =
      wall::Layers{.depth = "depth", .blending = 0.2, .outwards = {wall::Layer{0.3, {}}, wall::Layer{0.7, {}}}};
  composition.admixture = wall::Admixture{.share = "share", .material = {}};
  return composition;
}

std::vector<std::vector<double>> of_one(const distributed::DistributedMesh& mesh) {
  return {std::vector<double>(mesh.regions[0].elements.size(), 1.0)};
}

TEST(MaterialWeights, LayersAndShare) {
  const auto mesh = bar(0.25);
  const auto composition = layered();
  const auto weights = material_weights(mesh, {&composition}, of_one(mesh));
  for (std::size_t e = 0; e < mesh.regions[0].elements.size(); ++e) {
    const double d = mesh.regions[0].field("depth").values[e];
    const double middle = std::min(1.0, std::max(0.0, (d - 0.2) / 0.2)),
                 outer = std::min(1.0, std::max(0.0, (d - 0.6) / 0.2));
    const double expected[4] = {0.75 * (1 - middle), 0.75 * (middle - outer), 0.75 * outer, 0.25};
    for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(weights[0][4 * e + m], expected[m], 1e-14);
  }
}

/// Of quadratic elements each point has weights of its own, between depths that are given at the corners.
TEST(MaterialWeights, AtThePointsOfQuadraticElements) {
  auto data = mesh::box(4, 1, 1, {{1.0, 0.1, 0.1}}, mesh::RegionKind::wall);
  mesh::ElementField depth{"depth", 4, {}};
  for (const auto& t : data.tetrahedra)
    for (const auto n : t) depth.values.push_back(data.points[static_cast<std::size_t>(n)][0]);
  data.fields = {depth};
  wall::Composition composition;
  composition.layers = wall::Layers{.depth = "depth", .blending = 0.5, .outwards = {wall::Layer{0.5, {}}}};
  const auto linear = distributed::distribute(data, MPI_COMM_WORLD);
  mesh::add_edge_nodes(data);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  EXPECT_EQ(weight_points(linear, {&composition}), 0);
  ASSERT_EQ(weight_points(mesh, {&composition}), 4);
  const auto& region = mesh.regions[0];
  const auto weights = material_weights(mesh, {&composition}, of_one(mesh));
  ASSERT_EQ(weights[0].size(), 5 * 2 * region.elements.size());
  const auto outer = [](double d) { return std::min(1.0, std::max(0.0, (d - 0.25) / 0.5)); };
  for (std::size_t e = 0; e < region.elements.size(); ++e) {
    double centroid = 0;
    for (const auto n : region.elements[e]) centroid += 0.25 * mesh.points[static_cast<std::size_t>(n)][0];
    EXPECT_NEAR(weights[0][10 * e + 1], outer(centroid), 1e-14);
    for (std::size_t q = 0; q < 4; ++q) {
      double x = 0;
      for (std::size_t a = 0; a < 4; ++a)
        x += fe::quadratic_four_points[q].barycentric[a] *
             mesh.points[static_cast<std::size_t>(region.elements[e][a])][0];
      EXPECT_NEAR(weights[0][10 * e + 2 * (q + 1) + 1], outer(x), 1e-14);
      EXPECT_NEAR(weights[0][10 * e + 2 * (q + 1)], 1 - outer(x), 1e-14);
    }
  }
}

TEST(MaterialWeights, TwoCompositionsShareAnElement) {
  const auto mesh = bar(1.0);
  const auto composition = layered();
  const wall::Composition plain;
  std::vector<std::vector<double>> half{std::vector<double>(2 * mesh.regions[0].elements.size(), 0.5)};
  const auto weights = material_weights(mesh, {&plain, &composition}, half);
  for (std::size_t e = 0; e < mesh.regions[0].elements.size(); ++e) {
    EXPECT_EQ(weights[0][5 * e], 0.5);
    EXPECT_EQ(weights[0][5 * e + 4], 0.5);
  }
}

TEST(MaterialWeights, WrongArraysAreErrors) {
  const auto composition = layered();
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    const auto mesh = bar(share);
    EXPECT_THROW(material_weights(mesh, {&composition}, of_one(mesh)), InputError) << share;
  }
  auto other = layered();
  other.layers->depth = "thickness";
  const auto mesh = bar(0.5);
  EXPECT_THROW(material_weights(mesh, {&other}, of_one(mesh)), InputError);
}

}  // namespace
}  // namespace tunica::coupling
