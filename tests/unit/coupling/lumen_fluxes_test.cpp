// Flows through cuts against analytic ones, and the balance of a part of the lumen as the equations of a step leave it.
#include "tunica/coupling/lumen_fluxes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_cases.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

/// Two tears: a box whose middle third, in z, is the false lumen.
struct Box {
  distributed::DistributedMesh mesh;
  distributed::LumenMap map;
};

template <class InFalse>
distributed::LumenMap make_map(const distributed::DistributedMesh& mesh, const InFalse& in_false, double middle) {
  distributed::LumenMap map{
      .tears = {"tear_1", "tear_2"}, .cuts = {}, .in_false = {}, .parts = {}, .part_of = {}, .sticks = {}};
  for (const auto& face : mesh.faces) map.sticks.push_back(face.name == "lumen_wall");
  for (const auto& x : mesh.points) map.in_false.push_back(in_false(x) ? 1 : 0);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const auto& region = mesh.regions[r];
    for (std::int32_t e = 0; e < region.owned_elements && region.kind == mesh::RegionKind::lumen; ++e) {
      distributed::CutElement cut{static_cast<std::int32_t>(r), e, 0, {}};
      double sum = 0;
      for (int a = 0; a < 4; ++a) sum += cut.q[a] = map.in_false[region.elements[e][a]];
      if (sum == 0 || sum == 4) continue;
      cut.cut = mesh.points[region.elements[e][0]][2] < middle ? 0 : 1;
      map.cuts.push_back(cut);
    }
  }
  return map;
}

Box make_box(bool quadratic) {
  auto data = mesh::box(3, 3, 9, {{1, 1, 3}}, mesh::RegionKind::lumen);
  if (quadratic) mesh::add_edge_nodes(data);
  Box box{distributed::distribute(data, MPI_COMM_WORLD), {}};
  box.map = make_map(
      box.mesh, [](const Vec3<double>& x) { return x[2] > 0.9 && x[2] < 2.1; }, 1.5);
  return box;
}

/// v = (2 x, -x, -2 z + 5) is divergence-free. With a = -(v.grad) v as the rate nothing drives v apart from the mesh,
/// so that v' vanishes and v is what is carried.
test::Fields saddle(const distributed::DistributedMesh& mesh) {
  test::Fields f = test::random_fields(mesh, {.displacement = 0, .velocity = 0, .pressure = 0, .acceleration = 0});
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto& x = mesh.points[i];
    const Vec3<double> v{{2 * x[0], -x[0], 5 - 2 * x[2]}}, rate{{-4 * x[0], 2 * x[0], 2 * (5 - 2 * x[2])}};
    for (int c = 0; c < 3; ++c) {
      f.velocity_pressure[test::at(i) + static_cast<std::size_t>(c)] = v[c];
      f.acceleration[test::at(i) + static_cast<std::size_t>(c)] = rate[c];
    }
  }
  return f;
}

class Fluxes : public testing::TestWithParam<bool> {};

// Between the planes of nodes at z = 2/3 and 1, and at 2 and 7/3, q rises and falls: the flow that it weighs is the
// mean over the layer. The side x = 1 takes 2 out on each unit of area.
TEST_P(Fluxes, ADivergenceFreeFlowThroughTwoTears) {
  const Box box = make_box(GetParam());
  const auto fields = saddle(box.mesh);
  const fluid::Parameters blood = test::blood();
  const auto r = lumen_record({box.mesh, fields.view(), blood, 1e-3}, box.map);
  EXPECT_NEAR(r.tear_flows[0], 5 - 2 * (5.0 / 6), 1e-12);
  EXPECT_NEAR(r.tear_flows[1], -(5 - 2 * (13.0 / 6)), 1e-12);
  EXPECT_NEAR(r.in_false.outflow, 2 * 4.0 / 3, 1e-12);
  EXPECT_NEAR(r.in_false.volume, 4.0 / 3, 1e-13);
  EXPECT_EQ(r.in_false.volume_rate, 0);
  EXPECT_NEAR(r.residual, 0, 1e-12);
  EXPECT_NEAR(r.largest_flow, 10.0 / 3, 1e-12);
}

// A mesh that is drawn out along z takes the cuts along.
TEST_P(Fluxes, CutsMoveWithTheMesh) {
  const Box box = make_box(GetParam());
  auto fields = saddle(box.mesh);
  for (std::int32_t i = 0; i < box.mesh.nodes(); ++i)
    fields.mesh_velocity[test::at(i) + 2] = 0.3 * box.mesh.points[i][2];
  const fluid::Parameters blood = test::blood();
  const FluxStep step{box.mesh, fields.view(), blood, 1e-3};
  const auto q = box.map.in_false;
  EXPECT_NEAR(part_balance(step, q, box.map.sticks).volume_rate, 0.3 * 4.0 / 3, 1e-12);
  if (!GetParam()) return;  // linear elements: v' now is that of the convection by the mesh
  const auto r = lumen_record(step, box.map);
  EXPECT_NEAR(r.tear_flows[0], 5 - 2.3 * (5.0 / 6), 1e-12);
  EXPECT_NEAR(r.tear_flows[1], -(5 - 2.3 * (13.0 / 6)), 1e-12);
  EXPECT_NEAR(r.residual, 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Elements, Fluxes, testing::Bool(),
                         [](const auto& element) { return element.param ? "quadratic" : "linear"; });

// A tube whose middle is called the false lumen, its wall moving under a pulse that is far from balanced: what passes
// the two cuts is what the middle gains, to the tolerance of the solver, whereas v alone leaves something behind.
class Pulse : public testing::TestWithParam<bool> {};
TEST_P(Pulse, WhatPassesTheCutsIsWhatThePartGains) {
  const auto mesh = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_WORLD);
  auto input = test::fsi_input(test::pressure(1000), test::pressure(0));
  input.newton.relative_tolerance = 1e-8;
  input.linear.tolerance = input.linear.first_tolerance = 1e-6;
  Problem problem(mesh, input);
  const auto map = make_map(
      mesh, [](const Vec3<double>& x) { return x[2] > 0.005 && x[2] < 0.025; }, 0.015);
  State state = problem.initial_state();
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(problem.advance(state, 1e-4).converged);
    const auto r = lumen_record({mesh, problem.fields(), *input.fluid, 1e-4}, map);
    EXPECT_LT(std::abs(r.residual), 1e-7 * r.largest_flow) << k;
    EXPECT_GT(std::abs(r.in_false.volume_rate), 1e-3 * r.largest_flow) << k;
    // No opening lies in the middle. What passes its wall is the difference between edges and the means of corners.
    EXPECT_EQ(r.in_false.outflow, 0) << k;
    if (GetParam()) {
      EXPECT_GT(std::abs(r.in_false.leakage), 1e-2 * r.largest_flow) << k;
    } else {
      EXPECT_LT(std::abs(r.in_false.leakage), 1e-12 * r.largest_flow) << k;
    }
  }
}

// The norm of the residual ends a step long before; the balance of the middle takes one iteration more.
TEST_P(Pulse, AStepGoesOnUntilTheBalanceOfThePartCloses) {
  const auto mesh = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_WORLD);
  auto input = test::fsi_input(test::pressure(1000), test::pressure(0));
  input.newton.relative_tolerance = 1e-2;
  input.lumens = make_map(
      mesh, [](const Vec3<double>& x) { return x[2] > 0.005 && x[2] < 0.025; }, 0.015);
  double worst[2] = {};
  std::size_t iterations[2] = {};
  for (const int closing : {0, 1}) {
    input.newton.mass_tolerance = closing ? 1e-5 : 1;
    Problem problem(mesh, input);
    State state = problem.initial_state();
    double largest = 0;
    for (int k = 0; k < 5; ++k) {
      const auto report = problem.advance(state, 1e-4);
      ASSERT_TRUE(report.converged);
      iterations[closing] += report.iterations.size();
      const auto r = lumen_record({mesh, problem.fields(), *input.fluid, 1e-4}, input.lumens);
      largest = std::max(largest, r.largest_flow);
      worst[closing] = std::max(worst[closing], std::abs(r.residual) / largest);
    }
    EXPECT_NEAR(state.tear_flow_reference, largest, 1e-9 * largest);
  }
  EXPECT_GT(worst[0], 2e-5);
  EXPECT_LT(worst[1], 1e-5);
  EXPECT_GT(iterations[1], iterations[0]);
  EXPECT_LE(iterations[1], iterations[0] + 5);
}
INSTANTIATE_TEST_SUITE_P(Elements, Pulse, testing::Bool(),
                         [](const auto& element) { return element.param ? "quadratic" : "linear"; });

}  // namespace
}  // namespace tunica::coupling
