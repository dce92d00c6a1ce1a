#include "tunica/coupling/boundaries.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <string>

#include "small_cases.hpp"
#include "temporary_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::coupling {
namespace {

using test::at;

struct Bound {
  distributed::DistributedMesh mesh;
  assembly::BlockPattern pattern = assembly::make_pattern(mesh);
  Boundaries boundaries;

  Bound(const mesh::MeshData& data, const BoundaryInput& input)
      : mesh(distributed::distribute(data, MPI_COMM_WORLD)), boundaries(mesh, pattern, input) {}

  // By local node; free nodes are not there.
  std::map<std::int32_t, assembly::NodeConstraint> constraints() const {
    std::map<std::int32_t, assembly::NodeConstraint> result;
    for (const auto& c : boundaries.constraints().list()) result.insert({c.node, c});
    return result;
  }
  Vec3<double> sum(const std::vector<double>& field) const {
    double total[3] = {};
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      for (int c = 0; c < 3; ++c) total[c] += field[at(i) + c];
    parallel::global_sum(mesh.comm, total);
    return {{total[0], total[1], total[2]}};
  }
};

BoundaryInput flow_input(bc::Condition inlet, bc::Condition outlet, bc::Condition wall = bc::NoSlip{}) {
  BoundaryInput in;
  in.fluid = test::blood();
  in.conditions = {
      {"lumen_inlet", std::move(inlet)}, {"lumen_outlet", std::move(outlet)}, {"lumen_wall", std::move(wall)}};
  return in;
}

// Volume flow out of a face, from nodal velocities.
double outflow(const distributed::DistributedMesh& mesh, const std::string& name, const std::vector<double>& v) {
  const auto& face = mesh.face(name);
  double sum = 0;
  for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
    Vec3<double> x[3], mean{};
    for (int a = 0; a < 3; ++a) {
      const auto node = face.triangles[t][a];
      x[a] = mesh.points[node];
      mean = mean + (1.0 / 3.0) * Vec3<double>{{v[at(node)], v[at(node) + 1], v[at(node) + 2]}};
    }
    sum += 0.5 * dot(cross(x[1] - x[0], x[2] - x[0]), mean);
  }
  return parallel::global_sum(mesh.comm, sum);
}

double largest_difference(const Mat3<double>& a, const Mat3<double>& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
  return largest;
}

TEST(Boundaries, PrescribedFlowIsExactForEveryProfile) {
  for (const auto profile : {bc::Profile::parabolic, bc::Profile::flat}) {
    bc::Flow flow{.course = bc::WaveformInput{8e-5}, .positive = bc::Flow::Sign::inflow, .profile = profile};
    const Bound b(test::fluid_tube(), flow_input(flow, test::pressure(0.0)));
    std::vector<double> v(at(b.mesh.nodes()), 0.0);
    b.boundaries.prescribe(0.0, v);
    EXPECT_NEAR(outflow(b.mesh, "lumen_inlet", v), -8e-5, 1e-17);
    EXPECT_EQ(outflow(b.mesh, "lumen_outlet", v), 0.0);
    auto updated = v;
    b.mesh.halo.update(updated, 4);
    EXPECT_EQ(v, updated);
  }
}

TEST(Boundaries, NoSlipWinsOnSharedNodes) {
  const bc::Velocity plug{.value = {{0.1, 0.0, 0.3}}, .course = bc::WaveformInput{2.0}};
  const Bound b(test::fluid_tube(), flow_input(plug, test::pressure(0.0)));
  std::vector<double> v(at(b.mesh.nodes()), 0.0);
  b.boundaries.prescribe(0.0, v);
  std::vector<char> wall(b.mesh.nodes(), 0);
  for (const auto& triangle : b.mesh.face("lumen_wall").triangles)
    for (const auto node : triangle) wall[node] = 1;
  const auto constraints = b.constraints();
  int inner = 0;
  for (const auto& triangle : b.mesh.face("lumen_inlet").triangles)
    for (const auto node : triangle) {
      if (node >= b.mesh.owned_nodes) continue;  // a ghost may touch no wall triangle here
      EXPECT_EQ(v[at(node)], wall[node] ? 0.0 : 0.2);
      EXPECT_EQ(v[at(node) + 2], wall[node] ? 0.0 : 0.6);
      inner += wall[node] ? 0 : 1;
      const auto c = constraints.find(node);
      EXPECT_NE(c, constraints.end());
      if (c == constraints.end()) continue;
      EXPECT_EQ(largest_difference(c->second.P, Mat3<double>{}), 0.0);
      EXPECT_FALSE(c->second.pressure_fixed);
    }
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{inner}), 0);
}

// Along the other axes the nodes keep what they have, and blood that turns back is resisted as at an outlet.
TEST(Boundaries, VelocityAlongSomeAxesLeavesTheOthersFree) {
  bc::VelocityProfile profile;
  profile.velocity = {"0", "0", "10*t"};
  profile.directions = {false, false, true};
  const bc::Velocity sideways{.value = {{0.1, 0.2, 0}}, .course = bc::WaveformInput{2.0}, .directions = {true, true}};
  const Bound b(test::fluid_tube(), flow_input(profile, sideways, test::pressure(0.0)));
  std::vector<double> v(at(b.mesh.nodes()), 7.0);
  b.boundaries.prescribe(0.5, v);
  const auto constraints = b.constraints();
  const auto expect = [&](const char* face, const Vec3<double>& value, const Vec3<double>& free) {
    for (const auto& triangle : b.mesh.face(face).triangles)
      for (const auto node : triangle) {
        const auto c = constraints.find(node);
        ASSERT_NE(c, constraints.end());
        for (int i = 0; i < 3; ++i) {
          EXPECT_EQ(v[at(node) + i], value[i]);
          for (int j = 0; j < 3; ++j) EXPECT_EQ(c->second.P(i, j), i == j ? free[i] : 0.0);
        }
      }
  };
  expect("lumen_inlet", {{7, 7, 5}}, {{1, 1, 0}});
  expect("lumen_outlet", {{0.2, 0.4, 7}}, {{0, 0, 1}});
}

TEST(Boundaries, VelocityAlongAnAxisMeetsNoTiltedPlaneOfSymmetry) {
  bc::VelocityProfile profile;
  profile.velocity = {"1", "0", "0"};
  profile.directions = {true, false, false};
  EXPECT_THROW(Bound(test::turned_box(true), test::half_channel(profile)), InputError);
}

TEST(Boundaries, FixedWallsHoldAxesAndNormals) {
  BoundaryInput in;
  in.conditions = {{"symmetry_x", test::fixed_along_normal()},
                   {"symmetry_y", test::fixed_along_normal()},
                   {"wall_inlet", test::fixed_along_axes(true, false, true)},
                   {"wall_outlet", bc::Fixed{}},
                   {"wall_inner", test::pressure(1e3)},
                   {"wall_outer", bc::Free{}}};
  const Bound b(
      mesh::thick_cylinder(
          {.inner = 0.01, .outer = 0.012, .length = 0.01, .cells_radial = 2, .cells_around = 8, .cells_along = 3},
          mesh::Sector::quarter),
      in);
  const auto constraints = b.constraints();
  for (std::int32_t i = 0; i < b.mesh.nodes(); ++i) {
    const auto& x = b.mesh.points[i];
    const bool on_x = std::abs(x[0]) < 1e-9, on_y = std::abs(x[1]) < 1e-9;
    const bool inlet = std::abs(x[2]) < 1e-9, outlet = std::abs(x[2] - 0.01) < 1e-9;
    Mat3<double> expected = identity<double>();
    if (on_x || inlet || outlet) expected(0, 0) = 0;
    if (on_y || outlet) expected(1, 1) = 0;
    if (inlet || outlet) expected(2, 2) = 0;
    const auto c = constraints.find(i);
    const auto P = c == constraints.end() ? identity<double>() : c->second.P;
    EXPECT_LE(largest_difference(P, expected), 1e-12) << x[0] << " " << x[1] << " " << x[2];
  }
}

TEST(Boundaries, HoldTheHostOfAWallNodeAndOwnPressuresOnBothSides) {
  for (const bool mixed : {true, false}) {
    auto in = test::fsi_input(test::pressure(0.0), test::pressure(0.0)).boundary;
    in.wall_has_pressure = mixed;
    const Bound b(test::fsi_tube(), in);
    const auto constraints = b.constraints();
    std::vector<char> lumen(b.mesh.nodes(), 0);
    for (const auto& region : b.mesh.regions)
      if (region.kind == mesh::RegionKind::lumen)
        for (const auto& element : region.elements)
          for (const auto node : element) lumen[node] = 1;
    for (std::int32_t i = 0; i < b.mesh.owned_nodes; ++i) {
      const auto host = b.mesh.host[i];
      const auto own = constraints.find(i), hosts = constraints.find(host);
      if (host != i) {
        const double freedom = own == constraints.end() ? 3.0 : trace(own->second.P);
        EXPECT_EQ(freedom, 0.0) << "the host moves for its twin";
        const bool end = b.mesh.points[i][2] < 1e-9 || b.mesh.points[i][2] > 0.03 - 1e-9;
        EXPECT_EQ(hosts != constraints.end(), end);
      }
      const bool pressure_fixed = own != constraints.end() && own->second.pressure_fixed;
      EXPECT_EQ(pressure_fixed, !lumen[i] && !mixed);
    }
  }
}

TEST(Boundaries, ObliqueNormalsComeFromTheFace) {
  auto data = test::fluid_tube();
  const double angle = 0.6;
  for (auto& x : data.points)
    x = {{std::cos(angle) * x[0] + std::sin(angle) * x[2], x[1], -std::sin(angle) * x[0] + std::cos(angle) * x[2]}};
  const Bound b(data, flow_input(test::fixed_along_normal(), test::pressure(0.0), test::pressure(0.0)));
  const Vec3<double> n{{std::sin(angle), 0.0, std::cos(angle)}};
  Mat3<double> expected = identity<double>();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) expected(i, j) -= n[i] * n[j];
  for (const auto& [node, c] : b.constraints()) EXPECT_LE(largest_difference(c.P, expected), 1e-12);
  std::int64_t held = 0;
  for (const auto& [node, c] : b.constraints()) held += node < b.mesh.owned_nodes ? 1 : 0;
  EXPECT_EQ(parallel::global_sum(MPI_COMM_WORLD, held), 17) << "nodes of the inlet";
}

TEST(Boundaries, VectorsOfOutletsSumToTheAreaOfTheFace) {
  const bc::Resistance model{.resistance = 1e8, .distal_pressure = 50};
  for (const bool slipping : {true, false}) {
    const Bound b(test::fluid_tube(), flow_input(model, bc::Rcr{.proximal = 1e7, .capacitance = 1e-9, .distal = 1e8},
                                                 slipping ? test::pressure(0.0) : bc::Condition(bc::NoSlip{})));
    auto fields = test::random_fields(b.mesh, {.displacement = 3e-4});
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    const double pressures[] = {100.0, 0.0};
    const auto terms = b.boundaries.add_outlets(pressures, fields.view(), residual);
    EXPECT_EQ(terms.size(), 2U);
    const auto& face = b.mesh.face("lumen_inlet");
    double area[3] = {}, sum[3] = {};
    for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
      Vec3<double> x[3];
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) x[a][c] = fields.position[at(face.triangles[t][a]) + c];
      const auto vector = fluid::area_vector(x);
      for (int c = 0; c < 3; ++c) area[c] += vector[c];
    }
    const auto constraints = b.constraints();
    for (std::size_t k = 0; k < terms[0].nodes.size(); ++k) {
      for (int c = 0; c < 3; ++c) {
        const bool held = constraints.contains(terms[0].nodes[k]);
        EXPECT_TRUE(!held || terms[0].s[k][c] == 0.0) << "the rim is held";
        sum[c] += terms[0].s[k][c];
      }
    }
    parallel::global_sum(MPI_COMM_WORLD, area);
    parallel::global_sum(MPI_COMM_WORLD, sum);
    const auto force = b.sum(residual);
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(!slipping || std::abs(sum[c] - area[c]) < 1e-18);
      EXPECT_NEAR(force[c], 100.0 * area[c], 1e-15) << "all of the pressure acts, on the rim as well";
    }
    EXPECT_TRUE(slipping || std::abs(sum[2]) < 0.99 * std::abs(area[2]));

    // The flow is the product of these vectors with the velocity relative to the mesh.
    const auto flows = b.boundaries.outlet_flows(fields.view());
    double flow = 0;
    for (std::size_t k = 0; k < terms[0].nodes.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        const auto i = at(terms[0].nodes[k]) + c;
        flow += terms[0].s[k][c] * (fields.velocity_pressure[i] - fields.mesh_velocity[i]);
      }
    flow = parallel::global_sum(MPI_COMM_WORLD, flow);
    EXPECT_TRUE(!slipping || std::abs(flow - flows[0]) <= 1e-12 * std::abs(flows[0]));
  }
}

TEST(Boundaries, PressureOnAClosedSurfaceHasNoNetForce) {
  const auto data = mesh::thick_cylinder(
      {.inner = 0.01, .outer = 0.012, .length = 0.01, .cells_radial = 2, .cells_around = 8, .cells_along = 3},
      mesh::Sector::full);
  for (const bool follower : {true, false}) {
    BoundaryInput in;
    for (const char* name : {"wall_inner", "wall_outer", "wall_inlet", "wall_outlet"})
      in.conditions.push_back({name, bc::Pressure{bc::WaveformInput{1e4}, follower}});
    const Bound b(data, in);
    const auto fields = test::random_fields(b.mesh, {.displacement = 4e-4});
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    b.boundaries.loads().add(0.0, 1.0, fields.view(), {}, residual, nullptr);
    double largest = 0;
    for (std::size_t k = 0; k < at(b.mesh.owned_nodes); ++k) largest = std::max(largest, std::abs(residual[k]));
    EXPECT_GT(parallel::global_max(MPI_COMM_WORLD, largest), 1e-3);
    EXPECT_LE(norm(b.sum(residual)), 1e-14);
    // A follower does not turn the deformed body either; a dead load does.
    Vec3<double> moment{};
    for (std::int32_t i = 0; i < b.mesh.owned_nodes; ++i) {
      const Vec3<double> x{{fields.position[at(i)], fields.position[at(i) + 1], fields.position[at(i) + 2]}};
      moment = moment + cross(x, {{residual[at(i)], residual[at(i) + 1], residual[at(i) + 2]}});
    }
    double total[3] = {moment[0], moment[1], moment[2]};
    parallel::global_sum(MPI_COMM_WORLD, total);
    const double turning = std::hypot(total[0], total[1], total[2]);
    EXPECT_EQ(turning < 1e-14, follower) << turning;
  }
}

// Tangent of the loads of `in` times a direction against central differences of the loads.
void expect_consistent(const mesh::MeshData& data, const BoundaryInput& in) {
  const Bound b(data, in);
  const LoadCoefficients coefficients{0.7, 3e-4};
  const auto fields = test::random_fields(b.mesh, {.displacement = 2e-4, .velocity = 0.5});
  assembly::BlockMatrix matrix(b.pattern);
  std::vector<double> ignored(at(b.mesh.nodes()), 0.0);
  b.boundaries.loads().add(0.0, 0.8, fields.view(), coefficients, ignored, &matrix);
  std::vector<double> direction(at(b.mesh.nodes()), 0.0);
  for (std::int32_t i = 0; i < b.mesh.nodes(); ++i)
    for (int c = 0; c < 3 && b.mesh.host[i] == i; ++c)
      direction[at(i) + c] = test::noise(b.mesh.original_ids[i], 40 + c);
  // The lumen mesh is held.
  const auto loads = [&](double step) {
    auto f = fields;
    for (std::int32_t i = 0; i < b.mesh.nodes(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double d = step * direction[at(b.mesh.host[i]) + c];
        f.velocity_pressure[at(i) + c] += coefficients.velocity * d;
        f.displacement[at(i) + c] += coefficients.displacement * d;
      }
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    b.boundaries.loads().add(0.0, 0.8, f.view(), coefficients, residual, nullptr);
    return residual;
  };
  const double step = 1e-5;
  const auto plus = loads(step), minus = loads(-step);
  std::vector<double> product(at(b.mesh.owned_nodes));
  matrix.multiply(assembly::choose_isa(), direction, product);
  double sums[2] = {};
  for (std::size_t k = 0; k < product.size(); ++k) {
    sums[0] += std::pow((plus[k] - minus[k]) / (2 * step) - product[k], 2);
    sums[1] += product[k] * product[k];
  }
  parallel::global_sum(MPI_COMM_WORLD, sums);
  EXPECT_GT(sums[1], 0.0);
  EXPECT_LE(std::sqrt(sums[0]), 1e-6 * std::sqrt(sums[1]));
}

TEST(Boundaries, TangentOfWallLoadsIsTheirDerivative) {
  const auto data = mesh::thick_cylinder(
      {.inner = 0.01, .outer = 0.012, .length = 0.01, .cells_radial = 1, .cells_around = 8, .cells_along = 2},
      mesh::Sector::full);
  const auto input = [](bc::Condition inner, bc::Condition outer) {
    BoundaryInput in;
    in.conditions = {
        {"wall_inner", inner}, {"wall_outer", outer}, {"wall_inlet", bc::Free{}}, {"wall_outlet", bc::Free{}}};
    return in;
  };
  {
    SCOPED_TRACE("follower pressure");
    expect_consistent(data, input(test::pressure(1e4), bc::Free{}));
  }
  for (const auto direction : {bc::Support::Direction::full, bc::Support::Direction::normal}) {
    SCOPED_TRACE("support");
    expect_consistent(data, input(bc::Free{}, bc::Support{1e7, 2e4, 3e3, direction}));
  }
}

// Nodes on one, two and three planes keep two, one and no free motion; the mesh slides likewise.
TEST(Boundaries, PlanesOfSymmetryTakeOneDirectionEach) {
  for (const bool quadratic : {false, true}) {
    auto in = test::half_channel(bc::Symmetry{});
    const Bound b(test::turned_box(quadratic), in);
    std::map<std::int32_t, int> planes;
    for (const auto& [name, condition] : in.conditions) {
      if (!std::holds_alternative<bc::Symmetry>(condition)) continue;
      std::map<std::int32_t, bool> nodes;
      for (const auto& t : b.mesh.face(name).triangles)
        for (const auto node : t) nodes[node] = true;
      for (const auto& t : b.mesh.face(name).edges)
        for (const auto node : t) nodes[node] = true;
      for (const auto& [node, one] : nodes) planes[node] += 1;
    }
    std::map<std::int32_t, bool> still;
    for (const auto& t : b.mesh.face("y_max").triangles)
      for (const auto node : t) still[node] = true;
    for (const auto& t : b.mesh.face("y_max").edges)
      for (const auto node : t) still[node] = true;
    const auto constraints = b.constraints();
    for (const auto& [node, count] : planes) {
      if (node >= b.mesh.owned_nodes) continue;
      const auto c = constraints.find(node);
      ASSERT_NE(c, constraints.end());
      EXPECT_NEAR(trace(c->second.P), still.contains(node) ? 0 : 3 - count, 1e-12);
    }
    for (const auto& c : b.boundaries.mesh_constraints())
      if (c.node < b.mesh.owned_nodes && planes.contains(c.node) && !still.contains(c.node)) {
        EXPECT_LE(trace(c.P), 2.0 + 1e-12);
      }
  }
}

// The profile of an opening goes on behind a plane of symmetry and carries the whole flow.
TEST(Boundaries, FlowBesidePlanesOfSymmetryIsExact) {
  const Bound b(test::turned_box(false),
                test::half_channel(bc::Flow{.course = bc::WaveformInput{1e-5}, .positive = bc::Flow::Sign::inflow}));
  std::vector<double> v(at(b.mesh.nodes()), 0.0);
  b.boundaries.prescribe(0.0, v);
  EXPECT_NEAR(outflow(b.mesh, "x_min", v), -1e-5, 1e-17);
  double largest = 0;
  for (const auto& t : b.mesh.face("y_min").triangles)
    for (const auto node : t) largest = std::max(largest, norm(vector_at(v.data(), node)));
  // Fully developed between a wall and its mirror image: 3/2 of the mean on the plane (linear elements: a little less).
  EXPECT_NEAR(parallel::global_max(MPI_COMM_WORLD, largest), 1.5 * 1e-5 / (0.02 * 0.01), 0.05 * 0.075);
}

// What is prescribed loses its part across the planes that it meets.
TEST(Boundaries, ProfilesByFormulaStayInPlanesOfSymmetry) {
  bc::VelocityProfile profile;
  profile.velocity = {"1 + 10*x", "t", "2"};
  auto in = test::half_channel(profile);
  const Bound b(test::turned_box(true), in);
  std::vector<double> v(at(b.mesh.nodes()), 0.0);
  b.boundaries.prescribe(3.0, v);
  const Vec3<double> n2{{-0.8, 0.6, 0.0}};
  std::map<std::int32_t, int> on;
  const std::pair<const char*, int> faces[] = {{"x_min", 1}, {"y_min", 2}, {"z_min", 4}, {"z_max", 4}, {"y_max", 8}};
  for (const auto& [name, mark] : faces)
    for (const auto& t : b.mesh.face(name).triangles)
      for (const auto node : t) on[node] |= mark;
  int seen = 0;
  for (const auto& [node, marks] : on) {
    if (node >= b.mesh.owned_nodes || (marks & 1) == 0 || (marks & 8) != 0) continue;
    const auto& x = b.mesh.points[node];
    Vec3<double> expected{{1 + 10 * x[0], 3.0, 2.0}};
    const Vec3<double> e1{{0.36, 0.48, -0.8}}, e3 = cross(e1, n2);
    if ((marks & 2) != 0) expected = expected - dot(expected, n2) * n2;
    if ((marks & 4) != 0) expected = expected - dot(expected, e3) * e3;
    EXPECT_LE(norm(vector_at(v.data(), node) - expected), 1e-12);
    ++seen;
  }
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, std::int64_t{seen}), 0);
}

TEST(Boundaries, CurvedFacesAreNoPlaneOfSymmetry) {
  EXPECT_THROW(Bound(test::fluid_tube(), flow_input(test::pressure(1.0), test::pressure(0.0), bc::Symmetry{})),
               InputError);
}

TEST(Boundaries, TangentOfBackflowIsItsDerivative) {
  expect_consistent(test::fluid_tube(), flow_input(test::pressure(1e3), bc::Resistance{.resistance = 1e8}));
}

TEST(Boundaries, TangentOfAVelocityAlongSomeAxesIsItsDerivative) {
  const bc::Velocity still{.value = {}, .course = bc::WaveformInput{1.0}, .directions = {true, true, false}};
  expect_consistent(test::fluid_tube(), flow_input(test::pressure(1e3), still));
}

TEST(Boundaries, PressureLevelIsHeldAtOneNode) {
  auto in = flow_input(bc::Velocity{.value = {{0, 0, 1}}}, bc::Velocity{.value = {{0, 0, 1}}});
  in.pressure_point = PressurePoint{{{0.001, 0.001, 0.016}}, 250.0};
  const Bound b(test::fluid_tube(), in);
  std::int64_t held = 0;
  for (const auto& [node, c] : b.constraints())
    if (node < b.mesh.owned_nodes && c.pressure_fixed) {
      ++held;
      EXPECT_LE(norm(b.mesh.points[node] - Vec3<double>{{0.0, 0.0, 0.015}}), 1e-9);
    }
  EXPECT_EQ(parallel::global_sum(MPI_COMM_WORLD, held), 1);
  std::vector<double> v(at(b.mesh.nodes()), 0.0);
  b.boundaries.prescribe(0.0, v);
  double sum = 0;
  for (std::int32_t i = 0; i < b.mesh.owned_nodes; ++i) sum += v[at(i) + 3];
  EXPECT_EQ(parallel::global_sum(MPI_COMM_WORLD, sum), 250.0);
}

// k_s grows linearly along the tube, so that the mean of the nodes integrates it exactly on every triangle.
TEST(Boundaries, SupportVariesOverItsFace) {
  auto data = test::fsi_tube();
  const double length = test::tube_sizes(0.0).length;
  auto& field = data.node_fields.emplace_back();
  field.name = mesh::face_array_name("wall_outer", "k");
  for (const auto& x : data.points) field.values.push_back(1.0 + 2.0 * x[2] / length);
  auto input = test::fsi_input(test::pressure(0.0), test::pressure(0.0));
  const auto force_with = [&](const bc::SupportValue& stiffness) {
    input.boundary.conditions.back().second = bc::Support{.stiffness = stiffness};
    const Bound b(data, input.boundary);
    auto fields = test::random_fields(b.mesh, {0, 0, 0, 0});
    for (std::size_t k = 0; k < fields.displacement.size(); k += 4) fields.displacement[k] = 1e-4;
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    b.boundaries.loads().add(0.0, 1.0, fields.view(), {0.0, 1.0}, residual, nullptr);
    return b.sum(residual)[0];
  };
  const double constant = force_with(2e6), varying = force_with(bc::FaceArray{"k", 1e6});
  EXPECT_GT(constant, 0.1);
  EXPECT_NEAR(varying, constant, 1e-12 * constant);  // the mean of 1 .. 3 times 1e6
  EXPECT_THROW(force_with(bc::FaceArray{"stiffness", 1e6}), InputError);
  EXPECT_THROW(force_with(bc::FaceArray{"k", -1e6}), InputError);
}

TEST(Boundaries, NodalPressureIsAFollowerPressure) {
  auto input = test::fsi_input(test::pressure(0.0), test::pressure(0.0));
  const auto residual_with = [&](const bc::Condition& outer, double nodal) {
    input.boundary.conditions.back().second = outer;
    const auto mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
    input.boundary.wall_pressures.clear();
    if (nodal != 0) input.boundary.wall_pressures.emplace_back("wall_outer", std::vector(mesh.points.size(), nodal));
    const Bound b(test::fsi_tube(), input.boundary);
    const auto fields = test::random_fields(b.mesh);
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    b.boundaries.loads().add(0.0, 0.5, fields.view(), {0.0, 1.0}, residual, nullptr);
    return residual;
  };
  const auto expected = residual_with(test::pressure(3e3), 0.0), found = residual_with(bc::Free{}, 3e3);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-15);
}

/// A table of values at all points of a mesh.
class OverAFace : public testing::Test {
 protected:
  /// `line`: the values at a point.
  template <class Line>
  bc::OverFace table(const mesh::MeshData& data, const std::string& columns, const Line& line) const {
    // Each rank reads a file of its own, all of them the same.
    std::ofstream out(folder.path() / "table.csv");
    out << std::setprecision(17) << "x,y,z," << columns << "\n";
    for (const auto& x : data.points) out << x[0] << "," << x[1] << "," << x[2] << "," << line(x) << "\n";
    return {.table = folder.path() / "table.csv", .interpolation = bc::OverFace::Interpolation::nearest};
  }
  /// The loads of a condition on the outer side of a wall, at a displacement that is not zero.
  static std::vector<double> loads(const mesh::MeshData& data, const bc::Condition& outer) {
    const Bound b(data, input(outer));
    const auto fields = test::random_fields(b.mesh, {.displacement = 2e-4});
    std::vector<double> residual(at(b.mesh.nodes()), 0.0);
    b.boundaries.loads().add(0.0, 0.5, fields.view(), {0.0, 1.0}, residual, nullptr);
    return residual;
  }
  static BoundaryInput input(const bc::Condition& outer) {
    auto in = test::fsi_input(test::pressure(0.0), test::pressure(0.0)).boundary;
    in.conditions.back().second = outer;
    return in;
  }
  static void expect_same(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    double largest = 0;
    for (const double f : expected) largest = std::max(largest, std::abs(f));
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-12 * largest);
  }
  test::TemporaryFolder folder;
  static mesh::MeshData quadratic_tube() {
    auto tube = test::fsi_tube();
    mesh::add_edge_nodes(tube);
    return tube;
  }
  const mesh::MeshData tubes[2] = {test::fsi_tube(), quadratic_tube()};
};

TEST_F(OverAFace, OneValueEverywhereIsThatOfTheFace) {
  for (const auto& tube : tubes) {
    const bc::WaveformInput ramped{.source = 3e3, .scale = 1.5};
    const auto factor = table(tube, "factor", [](const auto&) { return "1"; });
    for (const bool follower : {true, false})
      expect_same(loads(tube, bc::Pressure{.pressure = ramped, .follower = follower, .over_face = factor}),
                  loads(tube, bc::Pressure{.pressure = ramped, .follower = follower}));
    auto tractions = table(tube, "tx,ty,tz", [](const auto&) { return "1,2,3"; });
    tractions.unit = 1e3;
    expect_same(loads(tube, bc::Traction{.course = {0.5}, .over_face = tractions}),
                loads(tube, bc::Traction{.vector = {{500, 1000, 1500}}}));
  }
}

// 2 z / length along the tube has the mean one, and its first moment is that of a line.
TEST_F(OverAFace, ALineIsIntegratedExactly) {
  const double length = test::tube_sizes(0.0).length;
  for (const auto& tube : tubes) {
    const auto line =
        table(tube, "tx,ty,tz", [&](const auto& x) { return std::to_string(2 * x[2] / length) + ",0,0"; });
    const Bound b(tube, input(bc::Free{}));
    // Without the backflow of the openings.
    const auto none = loads(tube, bc::Free{}), found = loads(tube, bc::Traction{.over_face = line}),
               one = loads(tube, bc::Traction{.vector = {{1, 0, 0}}});
    double sums[3] = {};
    for (std::int32_t i = 0; i < b.mesh.owned_nodes; ++i) {
      sums[0] += found[at(i)] - none[at(i)], sums[1] += one[at(i)] - none[at(i)];
      sums[2] += (found[at(i)] - none[at(i)]) * b.mesh.points[i][2];
    }
    parallel::global_sum(MPI_COMM_WORLD, sums);
    EXPECT_NEAR(sums[0], sums[1], 1e-6 * std::abs(sums[1]));
    EXPECT_NEAR(sums[2], 2.0 / 3 * length * sums[1], 1e-6 * std::abs(length * sums[1]));
  }
}

TEST_F(OverAFace, TheTangentIsTheDerivative) {
  for (const auto& tube : tubes) {
    const auto factor = table(tube, "factor", [](const auto& x) { return 1 + 30 * x[0] - 20 * x[1] + 10 * x[2]; });
    expect_consistent(tube, input(bc::Pressure{.pressure = {4e3}, .over_face = factor}));
  }
}

TEST_F(OverAFace, AFarTableIsRefused) {
  auto tractions = table(tubes[0], "tx,ty,tz", [](const auto&) { return "1,2,3"; });
  tractions.length_unit = 1e-6;
  EXPECT_THROW(loads(tubes[0], bc::Traction{.over_face = tractions}), InputError);
}

TEST(Boundaries, RefuseAFaceThatIsNotThere) {
  const auto mesh = distributed::distribute(test::fluid_tube(), MPI_COMM_WORLD);
  const auto pattern = assembly::make_pattern(mesh);
  auto in = flow_input(test::pressure(0.0), test::pressure(0.0));
  in.conditions.push_back({"lumen_exit", bc::NoSlip{}});
  EXPECT_THROW(Boundaries(mesh, pattern, in), InputError);
}

}  // namespace
}  // namespace tunica::coupling
