#include "tunica/analysis/lumens.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "small_vessels.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/lumen_fields.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::analysis {
namespace {

PostSettings defaults() { return config::parse_text(PostSettings::schema(), "{}").value; }

/// The flow of the cuts of a velocity along y on the mesh at rest, for the tear of this number.
double flow_along_y(const distributed::DistributedMesh& mesh, const distributed::LumenMap& map, int tear) {
  double flow = 0;
  for (const auto& cut : map.cuts) {
    if (cut.cut != tear) continue;
    const auto& nodes = mesh.regions[cut.region].elements[cut.element];
    Vec3<double> x[4];
    for (int a = 0; a < 4; ++a) x[a] = mesh.points[nodes[a]];
    const Vec3<double> e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
    const double six_volumes = dot(e1, cross(e2, e3));
    const Vec3<double> slope =
        (1 / six_volumes) * ((cut.q[1] - cut.q[0]) * cross(e2, e3) + (cut.q[2] - cut.q[0]) * cross(e3, e1) +
                             (cut.q[3] - cut.q[0]) * cross(e1, e2));
    flow += slope[1] * std::abs(six_volumes) / 6;
  }
  return parallel::global_sum(mesh.comm, flow);
}

class LumensOnAMesh : public ::testing::TestWithParam<bool> {
 protected:
  static distributed::DistributedMesh mesh_of(mesh::MeshData data) {
    if (GetParam()) mesh::add_edge_nodes(data);
    return distributed::distribute(data, MPI_COMM_WORLD);
  }
};

// Blood that moves towards the false lumen passes the whole section of 2 x 4 between them, whatever the cuts look like.
TEST_P(LumensOnAMesh, OneTearBetweenTwoPlates) {
  const auto mesh = mesh_of(testing::two_lumens());
  const auto lumens = find_lumens(mesh, testing::flow_in_two_lumens(), defaults());
  ASSERT_TRUE(lumens);
  ASSERT_EQ(lumens->tears.size(), 1U);
  EXPECT_EQ(lumens->map.tears, std::vector<std::string>{"tear_1"});
  EXPECT_NEAR(flow_along_y(mesh, lumens->map, 0), -8, 1e-9);
  const auto& centre = lumens->tears[0].centre;
  EXPECT_NEAR(centre[0], 1, 0.2);
  EXPECT_NEAR(centre[2], 2, 0.2);
  EXPECT_EQ(lumens->map.parts, (std::vector<std::string>{"true lumen", "false lumen", "tear_1"}));
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (mesh.regions[r].kind == mesh::RegionKind::lumen) {
      EXPECT_EQ(lumens->map.part_of[r].size(), static_cast<std::size_t>(mesh.regions[r].owned_elements));
    }
}

TEST_P(LumensOnAMesh, NothingTellsThemApartInATube) {
  EXPECT_FALSE(find_lumens(mesh_of(testing::tube()), testing::flow_in_tube(), defaults()));
}

// Two patches of a field: tears are counted from the inlet on, and what is far from them belongs to a lumen.
TEST_P(LumensOnAMesh, TearsAreNumberedDownstream) {
  auto data = mesh::box(4, 4, 24, {{1, 1, 6}}, mesh::RegionKind::lumen);
  const auto in_false = [](double z) { return z > 1.1 && z < 4.6; };
  data.node_fields.push_back(
      {mesh::lumen_side, testing::nodal(data, [&](const Vec3<double>& x) { return in_false(x[2]) ? -1.0 : 1.0; })});
  for (const bool upwards : {true, false}) {
    const auto mesh = mesh_of(data);
    const std::string inlet = upwards ? "z_min" : "z_max";
    RunDescription run{.fluid = true, .sticking_faces = {}, .inflow_faces = {inlet}};
    for (const char* side : {"x_min", "x_max", "y_min", "y_max"}) run.sticking_faces.emplace_back(side);
    const auto lumens = find_lumens(mesh, run, defaults());
    ASSERT_TRUE(lumens);
    ASSERT_EQ(lumens->tears.size(), 2U);
    EXPECT_NEAR(lumens->tears[upwards ? 0 : 1].centre[2], 1.1, 0.15) << inlet;
    EXPECT_NEAR(lumens->tears[upwards ? 1 : 0].centre[2], 4.6, 0.15) << inlet;
    EXPECT_NEAR(lumens->tears[0].area, 1, 1e-9);
    std::set<int> parts;
    for (const auto part : lumens->map.part_of[0]) parts.insert(part);
    EXPECT_LE(parts.size(), 4U);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, LumensOnAMesh, ::testing::Bool(),
                         [](const auto& element) { return element.param ? "quadratic" : "linear"; });

}  // namespace
}  // namespace tunica::analysis
