// Boundary layers on a square flapped_duct of one element size, where their heights are known.
#include <gtest/gtest.h>

#include <cmath>

#include "block_vessel.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/boundary_layers.hpp"

namespace tunica::meshing {
namespace {

using geometry::Point;

const test::BlockVessel flapped_duct{.across = 9, .along = 6, .flap_at = 4, .from = 6, .to = 6, .hole = false};

/// Node `level` layers away from an interface node; layers lie one after the other behind the old nodes.
struct Stacks {
  geometry::Index old, each;
  std::vector<geometry::Index> nodes;  ///< of the interface, ascending
  Stacks(const geometry::Tetrahedra& before, const geometry::Tetrahedra& after, int layers)
      : old(std::ssize(before.points)), each((std::ssize(after.points) - old) / layers) {
    std::vector<bool> on(before.points.size(), false);
    for (const auto& t : geometry::surface_triangles(before))
      if (t.neighbour_label == geometry::wall_label)
        for (const auto n : t.nodes) on[static_cast<std::size_t>(n)] = true;
    for (geometry::Index n = 0; n < old; ++n)
      if (on[static_cast<std::size_t>(n)]) nodes.push_back(n);
  }
  geometry::Index at(std::size_t k, int level) const {
    return level == 0 ? nodes[k] : old + (level - 1) * each + static_cast<geometry::Index>(k);
  }
};

TEST(LayerHeights, GrowByTheirFactorFromTheWallInwards) {
  for (const auto& settings : {BoundaryLayers{.layers = 3, .thickness = 0.2e-3, .growth = 1.5},
                               BoundaryLayers{.layers = 4, .thickness = 0.3e-3, .growth = 1}}) {
    const auto before = test::block_vessel(flapped_duct);
    auto mesh = before;
    const auto made = add_boundary_layers(mesh, settings);
    EXPECT_NEAR(made.median, settings.thickness, 1e-12);
    EXPECT_LE(made.largest, settings.thickness);
    const Stacks stacks(before, mesh, settings.layers);
    ASSERT_EQ(std::ssize(stacks.nodes), stacks.each);
    for (std::size_t k = 0; k < stacks.nodes.size(); ++k) {
      const auto point = [&](int level) { return mesh.points[static_cast<std::size_t>(stacks.at(k, level))]; };
      EXPECT_EQ(norm(point(0) - before.points[static_cast<std::size_t>(stacks.nodes[k])]), 0);
      const auto first = point(1) - point(0);
      for (int level = 1; level < settings.layers; ++level) {
        const auto next = point(level + 1) - point(level);
        EXPECT_NEAR(norm(next - std::pow(settings.growth, level) * first), 0, 1e-12);
      }
      // In the ends of the flapped_duct nodes stay there, and away from its edges they go straight inwards.
      const Point x = 1e3 * point(0);
      if (x[2] < 1e-9 || x[2] > 6 - 1e-9) {
        EXPECT_NEAR(first[2], 0, 1e-15);
      }
      if (std::abs(x[0] - 1) < 1e-9 && std::abs(x[1] - 4.5) < 2 && std::abs(x[2] - 3) < 2) {
        EXPECT_NEAR(norm(point(settings.layers) - point(0) - Point{{settings.thickness, 0, 0}}), 0, 1e-12);
      }
    }
    for (const auto& t : mesh.elements) EXPECT_GT(mesh::volume(mesh.points, t), 0);
    for (const int label : {geometry::lumen_label, geometry::wall_label})
      EXPECT_NEAR(test::volume(mesh, label) / test::volume(before, label), 1, 1e-12);
  }
}

TEST(LayerHeights, StayInThePlanesOfObliqueEnds) {
  auto before = test::block_vessel(flapped_duct);
  for (auto& x : before.points) x[2] += 0.4 * x[0];
  auto mesh = before;
  add_boundary_layers(mesh, {.layers = 2, .thickness = 0.2e-3, .growth = 1.2});
  const Stacks stacks(before, mesh, 2);
  int in_ends = 0;
  for (std::size_t k = 0; k < stacks.nodes.size(); ++k) {
    const auto height = [&](int level) {
      const auto& x = mesh.points[static_cast<std::size_t>(stacks.at(k, level))];
      return x[2] - 0.4 * x[0];
    };
    if (std::abs(height(0) - 3e-3) < 2.9e-3) continue;
    ++in_ends;
    EXPECT_NEAR(height(1), height(0), 1e-15);
    EXPECT_NEAR(height(2), height(0), 1e-15);
  }
  EXPECT_EQ(in_ends, 2 * 4 * 7);
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label) / test::volume(before, geometry::lumen_label), 1, 1e-12);
}

TEST(LayerHeights, AreBoundedByTheEdgesNearby) {
  auto mesh = test::block_vessel(flapped_duct);
  // Edges of 1 mm: at most 0.6 mm.
  const auto made = add_boundary_layers(mesh, {.layers = 1, .thickness = 2e-3, .growth = 1});
  EXPECT_LE(made.largest, 0.6e-3 + 1e-15);
  EXPECT_GT(made.smallest, 0);
  EXPECT_LE(made.smallest, made.median);
}

TEST(LayerHeights, DoNotDependOnPlaceAndDirection) {
  auto straight = test::block_vessel(flapped_duct), turned = straight;
  const double c = std::cos(0.8), s = std::sin(0.8);
  const auto move = [&](const Point& x) { return Point{{c * x[0] - s * x[2] + 0.2, x[1] + 0.1, s * x[0] + c * x[2]}}; };
  for (auto& x : turned.points) x = move(x);
  const BoundaryLayers settings{.layers = 2, .thickness = 0.25e-3, .growth = 1.3};
  add_boundary_layers(straight, settings);
  add_boundary_layers(turned, settings);
  ASSERT_EQ(straight.elements, turned.elements);
  for (std::size_t n = 0; n < straight.points.size(); ++n)
    EXPECT_NEAR(norm(turned.points[n] - move(straight.points[n])), 0, 1e-12);
}

}  // namespace
}  // namespace tunica::meshing
