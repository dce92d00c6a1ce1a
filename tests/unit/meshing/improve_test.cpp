#include "tunica/meshing/improve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "block_vessel.hpp"
#include "tunica/meshing/layers.hpp"
#include "tunica/meshing/local_mesh.hpp"
#include "tunica/meshing/mesh_report.hpp"

namespace tunica::meshing {
namespace {

double worst(const geometry::Tetrahedra& mesh) {
  double sine = 1;
  for (const auto& t : mesh.elements)
    sine = std::min(sine, worst_sine(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]));
  return sine;
}

TEST(Improve, MendsNodesThatWereShakenInside) {
  const auto box = mesh::box(10, 10, 10, {{0.01, 0.01, 0.01}}, mesh::RegionKind::wall);
  geometry::Tetrahedra mesh{box.points, box.tetrahedra, std::vector<int>(box.tetrahedra.size(), geometry::wall_label),
                            std::vector<bool>(box.points.size(), false)};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.33e-3, 0.33e-3);
  for (auto& p : mesh.points)
    if (p[0] > 1e-6 && p[1] > 1e-6 && p[2] > 1e-6 && p[0] < 0.00999 && p[1] < 0.00999 && p[2] < 0.00999) {
      const geometry::Point d{{shift(random), shift(random), shift(random)}};
      p = p + d;
    }
  for (auto& p : mesh.points) {  // nodes on edges of the box are to stay
    int on = 0;
    for (int i = 0; i < 3; ++i) on += p[i] < 1e-9 || p[i] > 0.01 - 1e-9;
    mesh.on_curve[&p - mesh.points.data()] = on > 1;
  }
  const double before = worst(mesh);
  ASSERT_LT(before, 0.03);
  // Nodes of the box's sides stay in their planes.
  const Projection sides = [](geometry::Point& p, const geometry::Point&, int, int, double) {
    for (int i = 0; i < 3; ++i) {
      if (std::abs(p[i]) < 1e-9) p[i] = 0;
      if (std::abs(p[i] - 0.01) < 1e-9) p[i] = 0.01;
    }
    return true;
  };
  const auto done = improve(mesh, sides, {}, [](const std::string&) {});
  EXPECT_GT(worst(mesh), std::sin(12 * 3.14159 / 180));
  EXPECT_GT(done.moves, 0);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label), 1e-6, 1e-13);  // the box is what it was
}

TEST(Layers, NoEdgeCrossesTheWallAfterwards) {
  auto mesh = test::block_vessel({.across = 7, .along = 10, .flap_at = 3, .from = 3, .to = 8, .hole = false});
  const double lumen = test::volume(mesh, geometry::lumen_label), wall = test::volume(mesh, geometry::wall_label);
  const auto sides = [&] {
    std::vector<std::array<geometry::Index, 3>> triangles;
    for (const auto& t : geometry::surface_triangles(mesh)) {
      const auto z = [&](int i) { return mesh.points[t.nodes[i]][2]; };
      const bool end = std::max({z(0), z(1), z(2)}) < 1e-9 || std::min({z(0), z(1), z(2)}) > 0.00999;
      if (t.neighbour_label == geometry::wall_label || !end) triangles.push_back(t.nodes);
    }
    return triangles;
  };
  const auto before = wall_layers(mesh, sides());
  ASSERT_GT(before.bridged_nodes, before.surface_nodes / 2);
  const geometry::Index added = double_layers(mesh, before.bridges);
  EXPECT_GT(added, 0);
  EXPECT_LT(added, std::ssize(before.bridges) / 2);  // most nodes are taken out again
  EXPECT_EQ(wall_layers(mesh, sides()).bridged_nodes, 0);
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label), lumen, 1e-15);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label), wall, 1e-15);
  EXPECT_GT(worst(mesh), 0);
  // The optimiser keeps it so.
  const Projection nowhere = [](geometry::Point&, const geometry::Point&, int, int, double) { return false; };
  improve(mesh, nowhere, {.wanted_dihedral = 40, .keep_layers = true}, [](const std::string&) {});
  EXPECT_EQ(wall_layers(mesh, sides()).bridged_nodes, 0);
}

}  // namespace
}  // namespace tunica::meshing
