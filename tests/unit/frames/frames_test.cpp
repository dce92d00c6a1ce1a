// Frames of small tubes: neighbours and directions on any number of ranks, and what is refused.
#include "tunica/frames/frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/element_shape.hpp"
#include "tunica/frames/depth.hpp"
#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {
namespace {

using test::message_of;

mesh::MeshData small_tube() {
  return mesh::tube({.radius = 0.01,
                     .length = 0.03,
                     .wall_thickness = 0.002,
                     .cells_around = 16,
                     .cells_radial = 1,
                     .cells_along = 6,
                     .cells_through_wall = 2});
}

const FrameFaces tube_faces{{"wall_inner"}, {"wall_inlet", "lumen_inlet"}, {"wall_outlet", "lumen_outlet"}};

std::vector<std::int64_t> neighbour_ids(const ElementGraph& graph, std::int32_t e, const std::vector<double>& ids) {
  std::vector<std::int64_t> result;
  for (const auto n : graph.neighbours(e)) result.push_back(static_cast<std::int64_t>(ids[n]));
  return result;
}

std::vector<double> ids_with_ghosts(const ElementGraph& graph) {
  std::vector<double> ids(static_cast<std::size_t>(graph.size()));
  for (std::int32_t e = 0; e < graph.owned(); ++e) ids[e] = static_cast<double>(graph.id(e));
  graph.update(ids, 1);
  return ids;
}

// ln(r / inner) / ln(outer / inner) of a tube; the mesh has two elements through the wall.
TEST(Depth, IsHarmonicThroughTheWall) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  const auto depth = depths(graph, {"wall_inner"}, {"wall_outer"});
  ASSERT_EQ(depth.size(), 4 * static_cast<std::size_t>(graph.owned()));
  const auto corner = [](double radius) { return std::log(radius / 0.01) / std::log(1.2); };
  std::size_t k = 0;
  for (std::int32_t e = 0; e < graph.owned(); ++e)
    for (const auto node : graph.nodes(e))
      EXPECT_NEAR(depth[k++], corner(std::hypot(mesh.points[node][0], mesh.points[node][1])), 0.03);
}

TEST(ElementGraph, NeighboursAndFacesDoNotDependOnTheRanks) {
  const auto data = small_tube();
  const auto whole_mesh = distributed::distribute(data, MPI_COMM_SELF),
             mesh = distributed::distribute(data, MPI_COMM_WORLD);
  const ElementGraph whole(whole_mesh), graph(mesh);
  const auto whole_ids = ids_with_ghosts(whole), ids = ids_with_ghosts(graph);
  std::map<std::int64_t, std::int32_t> local;
  for (std::int32_t e = 0; e < whole.owned(); ++e) local[whole.id(e)] = e;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    const auto same = local.at(graph.id(e));
    const auto neighbours = neighbour_ids(graph, e, ids);
    EXPECT_EQ(neighbours, neighbour_ids(whole, same, whole_ids));
    EXPECT_TRUE(std::is_sorted(neighbours.begin(), neighbours.end()));
    // Sides are inside the wall or in a named face. The order of an element's nodes, and so of its sides, is kept.
    std::size_t faces = 0;
    for (int side = 0; side < 4; ++side) {
      EXPECT_EQ(graph.face(e, side), whole.face(same, side));
      faces += graph.face(e, side) >= 0;
    }
    EXPECT_EQ(neighbours.size() + faces, 4u);
  }
  EXPECT_EQ(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{graph.owned()}), whole.owned());
}

TEST(Frames, DoNotDependOnTheRanks) {
  const auto data = small_tube();
  const auto whole_mesh = distributed::distribute(data, MPI_COMM_SELF),
             mesh = distributed::distribute(data, MPI_COMM_WORLD);
  const ElementGraph whole(whole_mesh), graph(mesh);
  std::map<std::int64_t, std::int32_t> local;
  for (std::int32_t e = 0; e < whole.owned(); ++e) local[whole.id(e)] = e;
  for (const NormalMethod& method : {NormalMethod(FilteredDyads{}), NormalMethod(ConditionalMean{})})
    for (const Domain domain : {Domain::wall, Domain::lumen_and_wall}) {
      const auto expected = make_frames(whole, tube_faces, {method, domain}),
                 found = make_frames(graph, tube_faces, {method, domain});
      for (std::int32_t e = 0; e < graph.owned(); ++e) {
        const auto same = local.at(graph.id(e));
        EXPECT_LT(norm(found.e1[e] - expected.e1[same]), 1e-7);
        EXPECT_LT(norm(found.e2[e] - expected.e2[same]), 1e-7);
        EXPECT_NEAR(found.jump[e], expected.jump[same], 1e-6);
        EXPECT_NEAR(found.confidence[e], expected.confidence[same], 1e-7);
      }
    }
}

TEST(Frames, JumpIsTheLargestAngleOfAnAxisToThatOfANeighbour) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_SELF);
  const ElementGraph graph(mesh);
  const auto f = make_frames(graph, tube_faces, {ConditionalMean{.cycles = 0}, Domain::wall});
  double largest = 0;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    double jump = 0;
    for (const auto n : graph.neighbours(e))
      for (const auto* axis : {&f.e1, &f.e2, &f.e3})
        jump = std::max(jump, std::acos(std::min(1.0, std::abs(dot((*axis)[e], (*axis)[n])))));
    EXPECT_NEAR(f.jump[e], jump, 1e-9);
    largest = std::max(largest, jump);
  }
  EXPECT_GT(largest, 0.39);  // from one of 16 facets to the next
}

TEST(Frames, AreOrthonormalRightHandedAndPointOutwards) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  // Vectors that are carried through a mesh of leaning elements go astray more than filtered dyads.
  for (const auto& [method, cosine] :
       {std::pair{NormalMethod(FilteredDyads{}), 0.995}, {NormalMethod(ConditionalMean{}), 0.92}}) {
    const auto f = make_frames(graph, tube_faces, {method, Domain::lumen_and_wall});
    for (std::int32_t e = 0; e < graph.owned(); ++e) {
      EXPECT_NEAR(dot(cross(f.e1[e], f.e2[e]), f.e3[e]), 1, 1e-12);
      const auto x = distributed::centroid(mesh, graph.nodes(e));
      EXPECT_GT(dot(f.e3[e], {{x[0], x[1], 0}}), cosine * std::hypot(x[0], x[1]));
      EXPECT_GT(f.e2[e][2], 0.999);  // from the inlet to the outlet
      EXPECT_GT(f.confidence[e], 0.7);
    }
  }
}

// Half of the tube's wall has no interface: vectors have to come from the other half.
TEST(Frames, ReachElementsFarFromTheInterface) {
  auto data = mesh::box(24, 2, 1, {{0.024, 0.002, 0.001}}, mesh::RegionKind::wall);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  // From the small face x = 0 through the length of the bar: e3 = x, and e2 along y.
  const FrameFaces faces{{"x_min"}, {"y_min"}, {"y_max"}};
  for (const NormalMethod& method : {NormalMethod(FilteredDyads{}), NormalMethod(ConditionalMean{})}) {
    const auto f = make_frames(graph, faces, {method, Domain::wall});
    for (std::int32_t e = 0; e < graph.owned(); ++e) {
      EXPECT_NEAR(f.e3[e][0], 1, 1e-9);
      EXPECT_NEAR(f.e2[e][1], 1, 1e-9);
      EXPECT_NEAR(f.e1[e][2], -1, 1e-9);
      EXPECT_NEAR(f.jump[e], 0, 1e-6);
      EXPECT_NEAR(f.confidence[e], 1, 1e-6);
    }
  }
}

TEST(Frames, SayWhereTheLongitudinalDirectionIsUndefined) {
  const auto mesh =
      distributed::distribute(mesh::box(4, 4, 2, {{0.01, 0.01, 0.002}}, mesh::RegionKind::wall), MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  // The potential rises across the wall: nothing of it lies in the plane.
  const auto f = make_frames(graph, {{"z_min"}, {"z_min"}, {"z_max"}}, {FilteredDyads{}, Domain::wall});
  EXPECT_EQ(f.undefined, 4 * 4 * 2 * 6);
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    EXPECT_EQ(f.confidence[e], 0);
    EXPECT_NEAR(dot(cross(f.e1[e], f.e2[e]), f.e3[e]), 1, 1e-12);
  }
}

TEST(Frames, RefuseFacesThatDoNotExistAndPartsOutOfReach) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_WORLD);
  const ElementGraph graph(mesh);
  const std::string message = message_of<InputError>([&] { make_frames(graph, {{"inner"}, {"wall_inlet"}, {}}, {}); });
  EXPECT_NE(message.find("there is no face 'inner'"), std::string::npos) << message;

  // Two boxes without a common node, the interface on one of them.
  auto two = mesh::box(2, 2, 2, {{1, 1, 1}}, mesh::RegionKind::wall);
  const auto other = two;
  const auto shift = std::ssize(two.points);
  for (const auto& p : other.points) two.points.push_back(p + Vec3<double>{{5, 0, 0}});
  for (auto t : other.tetrahedra) {
    for (auto& n : t) n += shift;
    two.tetrahedra.push_back(t);
  }
  two.regions[0].end_element = std::ssize(two.tetrahedra);
  for (auto face : other.faces) {
    face.name = "far_" + face.name;
    for (auto& t : face.triangles)
      for (auto& n : t) n += shift;
    two.faces.push_back(face);
  }
  const auto islands = distributed::distribute(two, MPI_COMM_WORLD);
  const ElementGraph parts(islands);
  const std::string unreached = message_of<InputError>([&] {
    make_frames(parts, {{"z_min"}, {"x_min", "far_x_min"}, {"x_max", "far_x_max"}}, {FilteredDyads{0.5}, Domain::wall});
  });
  EXPECT_NE(unreached.find("48 elements of the wall cannot be reached"), std::string::npos) << unreached;
}

TEST(Frames, MeanDirectionsLieAtTheirAngle) {
  const Vec3<double> e1{{0, 1, 0}}, e2{{0, 0, 1}};
  const auto m = mean_directions(e1, e2, 0.6);
  EXPECT_NEAR(std::acos(dot(m.m4, e1)), 0.6, 1e-12);
  EXPECT_NEAR(std::acos(dot(m.m6, e1)), 0.6, 1e-12);
  EXPECT_NEAR(dot(m.m4, e2), std::sin(0.6), 1e-12);
  EXPECT_NEAR(dot(m.m6, e2), -std::sin(0.6), 1e-12);
}

TEST(SymmetricTensor, PrincipalDirectionOfASumOfDyads) {
  const Vec3<double> a{{0.6, 0.8, 0}}, b{{-0.8, 0.6, 0}}, c{{0, 0, 1}};
  SymmetricTensor s{};
  for (const auto& [v, f] : {std::pair{a, 2.0}, {b, 5.0}, {c, 3.0}}) {
    const auto d = dyad(v, f);
    for (int i = 0; i < 6; ++i) s[i] += d[i];
  }
  const auto p = principal(s);
  EXPECT_NEAR(std::abs(dot(p.direction, b)), 1, 1e-14);
  EXPECT_NEAR(p.largest, 5, 1e-14);
  EXPECT_NEAR(p.second, 3, 1e-14);
}

TEST(Tears, AreRefusedForRegionsThatDoNotExistAndVesselsWithout) {
  const auto mesh = distributed::distribute(small_tube(), MPI_COMM_WORLD);
  const auto unknown = message_of<InputError>([&] { tear_points(mesh, {{"wall"}, {"false_wall"}}); });
  EXPECT_NE(unknown.find("no region 'false_wall'"), std::string::npos) << unknown;
  const auto none = message_of<InputError>([&] { tear_points(mesh, {{"wall"}, {}}); });
  EXPECT_NE(none.find("no region of `false_lumen` touches the lumen"), std::string::npos) << none;
}

}  // namespace
}  // namespace tunica::frames
