// Points found by place, and parts of a mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "check_mesh.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/point_locator.hpp"
#include "tunica/mesh/submesh.hpp"

namespace tunica::mesh {
namespace {

TEST(PointLocator, FindsWhatASearchOfAllPointsFinds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vec3<double>{{3 * any(random) - 2, any(random), 0.2 * any(random)}}; };
  std::vector<Vec3<double>> points;
  for (int k = 0; k < 400; ++k) points.push_back(point());
  constexpr double radius = 0.3;
  const PointLocator locator(points, radius);
  int found = 0, none = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto x = point();
    const double within = 0.5 * radius * (1 + any(random));
    std::int64_t nearest = -1;
    double distance = within;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (const double d = norm(points[p] - x); d <= distance) {
        distance = d;
        nearest = static_cast<std::int64_t>(p);
      }
    EXPECT_EQ(locator.nearest(x, within), nearest);
    (nearest < 0 ? none : found) += 1;
  }
  EXPECT_GT(found, 200);
  EXPECT_GT(none, 200);
}

TEST(PointLocator, LooksIntoTheCellsBesideAndUpToTheDistanceItself) {
  const std::vector<Vec3<double>> points = {{{0.999, -0.001, 0.5}}, {{-1e-9, 0, 0}}};
  const PointLocator locator(points, 1);
  EXPECT_EQ(locator.nearest({{1.001, 0.001, 0.5}}, 0.01), 0);
  EXPECT_EQ(locator.nearest({{-1e-9, 0, 1}}, 1), 1);  // just as far as asked for
  EXPECT_EQ(locator.nearest({{-1e-9, 0, 1}}, 0.9999), -1);
  EXPECT_EQ(PointLocator({}, 1).nearest({{0, 0, 0}}, 1), -1);
}

TEST(ShortestEdges, AreThoseOfTheTrianglesAtEachPoint) {
  // Two triangles of sides 3, 4, 5 and 4, 1, sqrt(17) and a point beside.
  const std::vector<Vec3<double>> points = {{{0, 0, 0}}, {{3, 0, 0}}, {{0, 4, 0}}, {{-1, 0, 0}}, {{9, 9, 9}}};
  const std::vector<std::array<std::int64_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(shortest_edges(points, triangles), (std::vector<double>{1, 3, 4, 1, 0}));
}

TEST(Submesh, LumenAndWallApartAreWhatTheyWereTogether) {
  auto whole = tube({.radius = 0.01, .length = 0.03, .wall_thickness = 0.002, .cells_around = 8, .cells_along = 4});
  // Fields that tell where a value belongs.
  ElementField of_elements{"place", 3, {}};
  for (const auto& t : whole.tetrahedra) {
    Vec3<double> c{{0, 0, 0}};
    for (const auto n : t) c = c + 0.25 * whole.points[static_cast<std::size_t>(n)];
    of_elements.values.insert(of_elements.values.end(), c.x, c.x + 3);
  }
  NodeField of_nodes{"height", {}};
  for (const auto& x : whole.points) of_nodes.values.push_back(x[2]);
  whole.fields = {of_elements};
  whole.node_fields = {of_nodes};
  std::size_t points = 0, elements = 0, faces = 0;
  for (const auto kind : {RegionKind::lumen, RegionKind::wall}) {
    const auto part = submesh(whole, kind);
    testing::expect_sound(part.data);
    EXPECT_TRUE(part.data.twins.empty());
    ASSERT_EQ(part.data.regions.size(), 1U);
    EXPECT_EQ(part.data.regions[0].name, kind == RegionKind::lumen ? "lumen" : "wall");
    ASSERT_EQ(part.nodes.size(), part.data.points.size());
    for (std::size_t n = 0; n < part.nodes.size(); ++n) {
      if (n > 0) {
        EXPECT_GT(part.nodes[n], part.nodes[n - 1]);
      }
      EXPECT_EQ(norm(part.data.points[n] - whole.points[static_cast<std::size_t>(part.nodes[n])]), 0);
      EXPECT_EQ(part.data.node_fields[0].values[n], part.data.points[n][2]);
    }
    ASSERT_EQ(part.elements.size(), part.data.tetrahedra.size());
    for (std::size_t e = 0; e < part.elements.size(); ++e) {
      const auto& t = part.data.tetrahedra[e];
      const auto& was = whole.tetrahedra[static_cast<std::size_t>(part.elements[e])];
      for (std::size_t a = 0; a < 4; ++a) EXPECT_EQ(part.nodes[static_cast<std::size_t>(t[a])], was[a]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(part.data.fields[0].values[3 * e + c],
                  of_elements.values[3 * static_cast<std::size_t>(part.elements[e]) + c]);
    }
    for (const auto& face : part.data.faces)
      EXPECT_NEAR(testing::area(part.data, face.name), testing::area(whole, face.name), 1e-18) << face.name;
    points += part.data.points.size();
    elements += part.data.tetrahedra.size();
    faces += part.data.faces.size();
  }
  EXPECT_EQ(points, whole.points.size());
  EXPECT_EQ(elements, whole.tetrahedra.size());
  EXPECT_EQ(faces, whole.faces.size());
  EXPECT_TRUE(submesh(box(1, 1, 1, {{1, 1, 1}}, RegionKind::wall), RegionKind::lumen).data.points.empty());
}

TEST(Submesh, OfQuadraticElementsHasTheirNodesOnEdges) {
  const TubeSizes sizes{.radius = 5e-3,
                        .length = 20e-3,
                        .wall_thickness = 1e-3,
                        .cells_around = 8,
                        .cells_radial = 1,
                        .cells_along = 4,
                        .cells_through_wall = 1};
  auto whole = tube(sizes);
  add_edge_nodes(whole);
  const auto part = submesh(whole, RegionKind::wall);
  ASSERT_EQ(part.data.edges.size(), part.data.tetrahedra.size());
  ASSERT_EQ(part.data.points.size(), part.nodes.size());
  for (std::size_t e = 0; e < part.elements.size(); ++e)
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_EQ(part.nodes[static_cast<std::size_t>(part.data.edges[e][k])],
                whole.edges[static_cast<std::size_t>(part.elements[e])][k]);
  auto again = submesh(tube(sizes), RegionKind::wall).data;
  add_edge_nodes(again);
  ASSERT_EQ(again.points.size(), part.data.points.size());
  const auto middle = [](const MeshData& data, std::int64_t node) {
    return data.points[static_cast<std::size_t>(node)];
  };
  for (std::size_t f = 0; f < again.faces.size(); ++f)
    for (std::size_t t = 0; t < again.faces[f].edges.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(norm(middle(again, again.faces[f].edges[t][k]) - middle(part.data, part.data.faces[f].edges[t][k])),
                  0);
}

}  // namespace
}  // namespace tunica::mesh
