#include "tunica/mesh/edge_nodes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/interface.hpp"

namespace tunica::mesh {
namespace {

double volume_of(const MeshData& data) {
  double sum = 0;
  for (const auto& t : data.tetrahedra) sum += volume(data.points, t);
  return sum;
}

TEST(EdgeNodes, EveryEdgeHasOneNodeInItsMiddle) {
  auto data = box(2, 3, 4, {{1, 1, 1}}, RegionKind::lumen);
  data.node_fields.push_back({"x", {}});
  for (const auto& x : data.points) data.node_fields[0].values.push_back(x[0]);
  const auto corners = static_cast<std::int64_t>(data.points.size());
  add_edge_nodes(data);
  std::map<std::set<std::int64_t>, std::int64_t> node_of;
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e)
    for (std::size_t k = 0; k < 6; ++k) {
      const auto a = data.tetrahedra[e][static_cast<std::size_t>(fe::edge_ends[k][0])],
                 b = data.tetrahedra[e][static_cast<std::size_t>(fe::edge_ends[k][1])], n = data.edges[e][k];
      EXPECT_GE(n, corners);
      EXPECT_EQ(node_of.try_emplace({a, b}, n).first->second, n);
      for (int c = 0; c < 3; ++c)
        EXPECT_DOUBLE_EQ(
            data.points[static_cast<std::size_t>(n)][c],
            0.5 * (data.points[static_cast<std::size_t>(a)][c] + data.points[static_cast<std::size_t>(b)][c]));
    }
  EXPECT_EQ(node_of.size(), data.points.size() - static_cast<std::size_t>(corners));
  for (const auto& face : data.faces) {
    ASSERT_EQ(face.edges.size(), face.triangles.size());
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(face.edges[t][k], node_of.at({face.triangles[t][k], face.triangles[t][(k + 1) % 3]}));
  }
  for (std::size_t i = 0; i < data.points.size(); ++i)
    EXPECT_DOUBLE_EQ(data.node_fields[0].values[i], data.points[i][0]);
}

// Euler: a surface of genus 1 has as many edges as corners and triangles together.
TEST(EdgeNodes, NodesOfTheInterfaceAreTwinsWhereTheCornersAre) {
  auto data = tube({.radius = 1,
                    .length = 2,
                    .wall_thickness = 0.2,
                    .cells_around = 8,
                    .cells_radial = 2,
                    .cells_along = 3,
                    .cells_through_wall = 1});
  const auto corners = data.twins.size();
  ASSERT_GT(corners, 0U);
  add_edge_nodes(data);
  const auto inner =
      std::find_if(data.faces.begin(), data.faces.end(), [](const auto& f) { return f.name == "wall_inner"; });
  ASSERT_NE(inner, data.faces.end());
  std::set<std::int64_t> edges;
  for (const auto& t : inner->edges) edges.insert(t.begin(), t.end());
  EXPECT_EQ(data.twins.size(), corners + edges.size());
  for (const auto& [twin, host] : data.twins) {
    EXPECT_NE(twin, host);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(data.points[static_cast<std::size_t>(twin)][c], data.points[static_cast<std::size_t>(host)][c],
                  1e-15);
  }
}

TEST(EdgeNodes, SubdivisionKeepsVolumesFacesAndOrientation) {
  auto data = box(2, 2, 2, {{1, 2, 3}}, RegionKind::wall);
  data.fields.push_back({"number", 1, {}});
  for (std::size_t e = 0; e < data.tetrahedra.size(); ++e) data.fields[0].values.push_back(static_cast<double>(e));
  add_edge_nodes(data);
  const auto fine = subdivided(data);
  ASSERT_EQ(fine.tetrahedra.size(), 8 * data.tetrahedra.size());
  EXPECT_NEAR(volume_of(fine), volume_of(data), 1e-13);
  for (std::size_t e = 0; e < fine.tetrahedra.size(); ++e) {
    EXPECT_NEAR(volume(fine.points, fine.tetrahedra[e]), volume(data.points, data.tetrahedra[e / 8]) / 8, 1e-14);
    EXPECT_EQ(fine.fields[0].values[e], static_cast<double>(e / 8));
  }
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    Vec3<double> before{}, after{};
    for (const auto& t : data.faces[f].triangles) before = before + area_vector(data.points, t);
    for (const auto& t : fine.faces[f].triangles) after = after + area_vector(fine.points, t);
    EXPECT_EQ(fine.faces[f].triangles.size(), 4 * data.faces[f].triangles.size());
    EXPECT_LT(norm(before - after), 1e-14);
  }
  EXPECT_EQ(fine.regions[0].end_element, std::ssize(fine.tetrahedra));
}

}  // namespace
}  // namespace tunica::mesh
