#include "tunica/meshing/local_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "block_vessel.hpp"
#include "tunica/meshing/reconnect.hpp"

namespace tunica::meshing {
namespace {

using Node = LocalMesh::Node;
using Cell = LocalMesh::Cell;

TEST(LocalMesh, WorstSineOfKnownShapes) {
  const geometry::Point a{{1, 1, 1}}, b{{-1, 1, -1}}, c{{1, -1, -1}}, d{{-1, -1, 1}};
  const double regular = std::sqrt(8.0) / 3;  // the dihedral angle has a cosine of 1/3
  EXPECT_NEAR(std::abs(worst_sine(a, b, c, d)), regular, 1e-12);
  EXPECT_NEAR(worst_sine(a, b, c, d), -worst_sine(b, a, c, d), 1e-12);
  // The corner of a cube: three right angles, three of 54.7 degrees.
  EXPECT_NEAR(worst_sine({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}), std::sqrt(2.0 / 3), 1e-12);
  EXPECT_EQ(worst_sine({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{1, 1, 0}}), 0);
}

TEST(LocalMesh, NodesKnowWhereTheyAre) {
  const auto mesh = test::block_vessel({});
  const LocalMesh local(mesh);
  geometry::Index inner = 0, surface = 0, curve = 0;
  for (Node n = 0; n < std::ssize(mesh.points); ++n) {
    inner += local.place(n) == LocalMesh::Place::inner;
    surface += local.place(n) == LocalMesh::Place::surface;
    curve += local.place(n) == LocalMesh::Place::curve;
    const geometry::Point& x = mesh.points[n];
    if (x[0] == 0 && x[1] > 0.0015 && x[1] < 0.0075 && x[2] > 0.0005 && x[2] < 0.0235) {
      EXPECT_EQ(local.place(n), LocalMesh::Place::surface);
      EXPECT_EQ(local.sides(n), (std::array<int, 2>{geometry::wall_label, geometry::outside_label}));
      EXPECT_NEAR(norm(local.normal(n) - geometry::Point{{-1, 0, 0}}), 0, 1e-12);
    }
  }
  EXPECT_GT(inner, 0);
  EXPECT_EQ(curve, 2 * 4 * 7);  // the rims of the lumen at both ends
  EXPECT_EQ(inner + surface + curve, std::ssize(mesh.points));
}

TEST(LocalMesh, RingsAreClosedInsideAndOpenOutside) {
  const auto mesh = test::block_vessel({});
  const LocalMesh local(mesh);
  geometry::Index closed = 0, open = 0;
  for (Cell c = 0; c < local.cells(); c += 7) {
    const auto& k = local.corners(c);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) {
        const auto ring = local.ring(k[a], k[b]);
        ASSERT_TRUE(ring);
        (ring->closed ? closed : open) += 1;
        EXPECT_EQ(ring->nodes.size(), ring->cells.size() + (ring->closed ? 0 : 1));
        // Every element of the ring is positive in the order that the ring tells.
        for (std::size_t i = 0; i < ring->cells.size(); ++i)
          EXPECT_GT(local.cell_sine({k[a], k[b], ring->nodes[i], ring->nodes[(i + 1) % ring->nodes.size()]}), 0);
      }
  }
  EXPECT_GT(closed, 1000);
  EXPECT_GT(open, 100);
}

TEST(LocalMesh, SplittingKeepsVolumesAndIsComplete) {
  auto mesh = test::block_vessel({});
  const double lumen = test::volume(mesh, geometry::lumen_label), wall = test::volume(mesh, geometry::wall_label);
  LocalMesh local(mesh);
  const auto k = local.corners(1000);
  const auto ring = local.ring(k[0], k[1]);
  const auto cells = std::ssize(mesh.elements);
  const Node middle = local.split(k[0], k[1]);
  EXPECT_FALSE(local.is_edge(k[0], k[1]));
  EXPECT_TRUE(local.is_edge(k[0], middle));
  mesh = local.extract();
  EXPECT_EQ(std::ssize(mesh.elements), cells + std::ssize(ring->cells));
  EXPECT_NEAR(test::volume(mesh, geometry::lumen_label), lumen, 1e-15);
  EXPECT_NEAR(test::volume(mesh, geometry::wall_label), wall, 1e-15);
  for (const auto& t : geometry::surface_triangles(mesh)) EXPECT_GE(t.label, 1);
}

/// Three elements around the edge (0, 1), flat enough that two around the face (2, 3, 4) are better.
TEST(Reconnect, RemovesAnEdgeOfThree) {
  geometry::Tetrahedra mesh;
  const double low = 0.05;
  mesh.points = {{{0, 0, -low}}, {{0, 0, low}}, {{1, 0, 0}}, {{-0.5, 0.87, 0}}, {{-0.5, -0.87, 0}}};
  mesh.points[0][2] = -0.8;
  mesh.points[1] = {{0.9, 0.05, 0.8}};
  mesh.elements = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
  mesh.labels = {1, 1, 1};
  mesh.on_curve.assign(5, false);
  LocalMesh local(mesh);
  double before = 1;
  for (Cell c = 0; c < 3; ++c) before = std::min(before, local.sine(c));
  ASSERT_GT(before, 0);
  ASSERT_TRUE(reconnect(local, 0, {}));
  const auto after = local.extract();
  EXPECT_EQ(after.elements.size(), 2U);
  EXPECT_NEAR(test::volume(after, 1), test::volume(mesh, 1), 1e-12);
  const LocalMesh again(after);
  EXPECT_GT(std::min(again.sine(0), again.sine(1)), before);
  // And back: nothing to gain.
  LocalMesh back(after);
  EXPECT_FALSE(reconnect(back, 0, {}));
}

/// A flat element that lies on a plane outer surface goes away.
TEST(Reconnect, TakesAFlatElementOffTheSurface) {
  geometry::Tetrahedra mesh;
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0.5, 0.5, -0.7}}};
  // The upper nodes 0 and 2 are hardly higher: between them and 1, 3 lies the flat element.
  mesh.points[0][2] = mesh.points[2][2] = 1e-9;
  mesh.elements = {{0, 1, 3, 4}, {1, 2, 3, 4}, {0, 1, 2, 3}};
  for (auto& t : mesh.elements) {
    const auto& p = mesh.points;
    if (worst_sine(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) < 0) std::swap(t[0], t[1]);
  }
  mesh.labels = {1, 1, 1};
  mesh.on_curve.assign(5, false);
  LocalMesh local(mesh);
  ASSERT_LT(local.sine(2), 1e-6);
  EXPECT_TRUE(reconnect(local, 2, {}));
  const auto after = local.extract();
  EXPECT_EQ(after.elements.size(), 2U);
  EXPECT_EQ(geometry::surface_triangles(after).size(), 6U);
}

/// A rhombus (0, 2, 1, 3) cut along its long diagonal (0, 1), with node 4 above and, for two labels, node 5 below it.
/// `bend`: height of the nodes beside the diagonal.
geometry::Tetrahedra rhombus(bool two_labels, double bend) {
  geometry::Tetrahedra mesh;
  mesh.points = {{{-1, 0, 0}}, {{1, 0, 0}}, {{0, 0.35, bend}}, {{0, -0.35, bend}}, {{0, 0, 0.6}}, {{0, 0, -0.6}}};
  mesh.elements = {{0, 1, 2, 4}, {1, 0, 3, 4}};
  mesh.labels = {1, 1};
  if (two_labels) {
    mesh.elements.insert(mesh.elements.end(), {{0, 2, 1, 5}, {1, 3, 0, 5}});
    mesh.labels.insert(mesh.labels.end(), {2, 2});
  } else {
    mesh.points.pop_back();
  }
  mesh.on_curve.assign(mesh.points.size(), false);
  return mesh;
}

TEST(Reconnect, TurnsAnEdgeOfAPlaneSurface) {
  for (const bool two_labels : {false, true}) {
    LocalMesh local(rhombus(two_labels, 0));
    ASSERT_GT(local.sine(0), 0);
    EXPECT_TRUE(reconnect(local, 0, {}));
    EXPECT_FALSE(local.is_edge(0, 1));
    EXPECT_TRUE(local.is_edge(2, 3));
    const auto after = local.extract();
    EXPECT_EQ(after.elements.size(), two_labels ? 4U : 2U);
    EXPECT_NEAR(test::volume(after, 1), test::volume(rhombus(two_labels, 0), 1), 1e-12);
    EXPECT_NEAR(test::volume(after, 2), test::volume(rhombus(two_labels, 0), 2), 1e-12);
  }
}

TEST(Reconnect, LeavesSurfacesAsTheyAreWhenAsked) {
  for (const bool two_labels : {false, true}) {
    LocalMesh local(rhombus(two_labels, 0));
    EXPECT_FALSE(reconnect(local, 0, {.keep_surface = true}));
    EXPECT_TRUE(local.is_edge(0, 1));
  }
}

TEST(Reconnect, KeepsAnEdgeWhereTheSurfaceBends) {
  for (const bool two_labels : {false, true})
    for (const double bend : {0.15, -0.15}) {
      LocalMesh local(rhombus(two_labels, bend));
      ASSERT_GT(local.sine(0), 0);
      reconnect(local, 0, {});
      EXPECT_TRUE(local.is_edge(0, 1));
    }
}

}  // namespace
}  // namespace tunica::meshing
