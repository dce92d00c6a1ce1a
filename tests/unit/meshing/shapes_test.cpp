// Angles, ratios, handles and layers of bodies that are known exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "block_vessel.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/mesh_report.hpp"

namespace tunica::meshing {
namespace {

using Triangle = std::array<geometry::Index, 3>;

mesh::MeshData one(const std::array<geometry::Point, 4>& x) {
  return {{x.begin(), x.end()}, {{0, 1, 2, 3}}, {}, {}, {}, {}, {}};
}
constexpr std::array<geometry::Point, 4> regular = {{{{1, 1, 1}}, {{-1, 1, -1}}, {{1, -1, -1}}, {{-1, -1, 1}}}};
constexpr std::array<geometry::Point, 4> corner = {{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}};

TEST(Shapes, OfTheRegularTetrahedronAndTheCornerOfACube) {
  auto turned = regular;
  if (mesh::volume({turned.begin(), turned.end()}, {0, 1, 2, 3}) < 0) std::swap(turned[2], turned[3]);
  auto s = shapes(one(turned), 0, 1);
  EXPECT_NEAR(s.smallest_dihedral, std::acos(1.0 / 3) * 180 / M_PI, 1e-10);
  EXPECT_NEAR(s.smallest_radius_ratio, 1, 1e-12);
  EXPECT_NEAR(s.shortest_edge, std::sqrt(8.0), 1e-14);
  EXPECT_NEAR(s.longest_edge, std::sqrt(8.0), 1e-14);
  EXPECT_EQ(s.dihedral_histogram[14], 1);
  EXPECT_EQ(s.radius_ratio_histogram[9], 1);

  s = shapes(one(corner), 0, 1);
  EXPECT_NEAR(s.smallest_dihedral, std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-10);
  // Inradius 1 / (3 + sqrt 3), circumradius sqrt(3) / 2.
  EXPECT_NEAR(s.smallest_radius_ratio, 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2), 1e-12);
  EXPECT_NEAR(s.mean_edge, (1 + std::sqrt(2.0)) / 2, 1e-14);
  EXPECT_EQ(s.dihedral_histogram[10], 1);  // 50 to 55 degrees
}

TEST(Shapes, DoNotDependOnPlaceSizeAndDirection) {
  const auto box = mesh::box(3, 2, 4, {{1.3, 0.7, 2.9}}, mesh::RegionKind::wall);
  auto moved = box;
  const double c = std::cos(0.6), s = std::sin(0.6);
  for (auto& x : moved.points) x = 1e-3 * geometry::Point{{c * x[0] - s * x[1] + 7, s * x[0] + c * x[1], x[2] - 5}};
  const auto all = std::ssize(box.tetrahedra);
  const auto before = shapes(box, 0, all), after = shapes(moved, 0, all);
  EXPECT_NEAR(after.smallest_dihedral, before.smallest_dihedral, 1e-8);
  EXPECT_NEAR(after.smallest_radius_ratio, before.smallest_radius_ratio, 1e-10);
  EXPECT_NEAR(after.mean_edge, 1e-3 * before.mean_edge, 1e-15);
  EXPECT_NEAR(after.longest_edge, 1e-3 * before.longest_edge, 1e-15);
}

TEST(Shapes, CountTheElementsThatAreAskedForAndInvertedOnesAsFlat) {
  auto data = mesh::box(2, 2, 2, {{1, 1, 1}}, mesh::RegionKind::wall);
  EXPECT_EQ(shapes(data, 5, 17).elements, 12);
  std::swap(data.tetrahedra[7][0], data.tetrahedra[7][1]);
  EXPECT_EQ(shapes(data, 5, 17).smallest_dihedral, 0);
  EXPECT_EQ(shapes(data, 5, 17).dihedral_histogram[0], 1);
  EXPECT_GT(shapes(data, 8, 17).smallest_dihedral, 40);
}

/// A torus of n by m quadrangles, each cut in two; its nodes begin at `first`.
std::vector<Triangle> torus(geometry::Index n, geometry::Index m, geometry::Index first) {
  std::vector<Triangle> triangles;
  for (geometry::Index i = 0; i < n; ++i)
    for (geometry::Index j = 0; j < m; ++j) {
      const auto node = [&](geometry::Index a, geometry::Index b) { return first + (a % n) * m + b % m; };
      triangles.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      triangles.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return triangles;
}
/// Two closed surfaces become one, with the handles of both: a triangle of each is taken out and the rims are joined.
std::vector<Triangle> joined(std::vector<Triangle> a, std::vector<Triangle> b) {
  const auto rim = a.back(), other = b.back();
  a.pop_back();
  b.pop_back();
  for (auto& t : b)
    for (auto& n : t)
      for (int k = 0; k < 3; ++k)
        if (n == other[k]) {
          n = rim[(3 - k) % 3];
          break;
        }
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Topology, CountsHandlesAndParts) {
  auto t = topology({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  EXPECT_EQ(t.genus, 0);
  EXPECT_EQ(t.parts, 1);
  EXPECT_TRUE(t.manifold);
  // Two that share an edge: there are four triangles, though none is open.
  EXPECT_FALSE(
      topology({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {0, 5, 4}}).manifold);
  EXPECT_EQ(topology(torus(4, 5, 10)).genus, 1);
  auto surface = joined(torus(4, 5, 0), torus(6, 4, 100));
  t = topology(surface);
  EXPECT_EQ(t.genus, 2);
  EXPECT_EQ(t.parts, 1);
  EXPECT_TRUE(t.manifold);
  surface = joined(surface, torus(5, 5, 1000));
  EXPECT_EQ(topology(surface).genus, 3);
  const auto more = torus(4, 4, 5000);
  surface.insert(surface.end(), more.begin(), more.end());
  EXPECT_EQ(topology(surface).parts, 2);
  EXPECT_EQ(topology(surface).genus, 4);
  surface.push_back({5000, 5001, 9999});  // a fin on an edge
  EXPECT_FALSE(topology(surface).manifold);
}

/// A slab of wall with `layers` cells between its sides at z = 0 and 1.
TEST(WallLayers, ASlabIsAsThickAsItsCells) {
  for (const int layers : {1, 2, 3}) {
    const auto box = mesh::box(4, 4, layers, {{4, 4, 1}}, mesh::RegionKind::wall);
    const geometry::Tetrahedra mesh{box.points, box.tetrahedra,
                                    std::vector<int>(box.tetrahedra.size(), geometry::wall_label),
                                    std::vector<bool>(box.points.size(), false)};
    std::vector<Triangle> sides;
    for (const auto& face : box.faces)
      if (face.name == "z_min" || face.name == "z_max")
        sides.insert(sides.end(), face.triangles.begin(), face.triangles.end());
    const auto found = wall_layers(mesh, sides);
    EXPECT_EQ(found.surface_nodes, 2 * 25);
    EXPECT_EQ(found.bridged_nodes, layers == 1 ? 2 * 25 : 0);
    // Kuhn's split: upright edges, one diagonal of each upright face, one of each cell.
    EXPECT_EQ(std::ssize(found.bridges), layers == 1 ? 25 + 2 * 4 * 5 + 16 : 0);
    auto lumen = mesh;
    for (auto& label : lumen.labels) label = geometry::lumen_label;
    EXPECT_EQ(wall_layers(lumen, sides).bridged_nodes, 0);
  }
}

}  // namespace
}  // namespace tunica::meshing
