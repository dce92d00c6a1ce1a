#include "tunica/coupling/problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

using test::at;

constexpr double time_step = 2e-4;  // s

void expect_same_bits(const State& a, const State& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.dt, b.dt);
  EXPECT_EQ(a.velocity_pressure, b.velocity_pressure);
  EXPECT_EQ(a.acceleration, b.acceleration);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.displacement_rate, b.displacement_rate);
  EXPECT_EQ(a.residual_reference, b.residual_reference);
  ASSERT_EQ(a.outlets.size(), b.outlets.size());
  for (std::size_t k = 0; k < a.outlets.size(); ++k) EXPECT_EQ(a.outlets[k].state(), b.outlets[k].state());
}

double largest_value(const distributed::DistributedMesh& mesh, const std::vector<double>& field) {
  double size = 0;
  for (std::size_t k = 0; k < field.size(); ++k)
    if (k % 4 < 3) size = std::max(size, std::abs(field[k]));
  return parallel::global_max(mesh.comm, size);
}

bc::Condition windkessel() { return bc::Rcr{.proximal = 2e7, .capacitance = 1e-9, .distal = 2e8}; }

ProblemInput exact_flow_input() {
  ProblemInput in;
  in.fluid = test::blood();
  in.boundary.fluid = in.fluid;
  in.boundary.conditions = {
      {"lumen_inlet", test::pressure(500.0)}, {"lumen_outlet", windkessel()}, {"lumen_wall", bc::NoSlip{}}};
  in.newton.relative_tolerance = 1e-10;
  in.linear.tolerance = in.linear.first_tolerance = 1e-6;
  return in;
}

ProblemInput bar_input(wall::Element element, double stress) {
  ProblemInput in;
  in.wall = test::soft_wall(element);
  in.boundary.wall_has_pressure = element == wall::Element::mixed;
  const bc::Traction pull{.vector = {{stress, 0, 0}}};
  in.boundary.conditions = {{"x_min", test::fixed_along_axes(true, false, false)},
                            {"y_min", test::fixed_along_axes(false, true, false)},
                            {"z_min", test::fixed_along_axes(false, false, true)},
                            {"x_max", pull},
                            {"y_max", bc::Free{}},
                            {"z_max", bc::Free{}}};
  in.newton.relative_tolerance = 1e-9;
  in.linear.tolerance = in.linear.first_tolerance = 1e-6;
  return in;
}

TEST(Problem, WithoutLoadsStaysAtRest) {
  const auto mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
  Problem problem(mesh, test::fsi_input(test::pressure(0.0), windkessel()));
  auto state = problem.initial_state();
  for (int step = 1; step <= 3; ++step) {
    const auto report = problem.advance(state, time_step);
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_EQ(state.step, step);
  }
  EXPECT_NEAR(state.time, 3 * time_step, 1e-15);
  for (const auto* field :
       {&state.velocity_pressure, &state.acceleration, &state.displacement, &state.displacement_rate})
    EXPECT_EQ(*field, std::vector<double>(at(mesh.nodes()), 0.0));
}

class ProblemOfElements : public testing::TestWithParam<bool> {};  // quadratic?
INSTANTIATE_TEST_SUITE_P(Elements, ProblemOfElements, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "quadratic" : "linear"; });

TEST_P(ProblemOfElements, StepIsTheSameOnAnyNumberOfRanks) {
  const auto parts = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_WORLD);
  const auto whole = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_SELF);
  auto input = test::fsi_input(test::pressure(1000.0), windkessel());
  input.newton.relative_tolerance = 1e-8;
  input.newton.mesh_tolerance = 1e-9;
  Problem many(parts, input), one(whole, input);
  auto a = many.initial_state(), b = one.initial_state();
  for (int step = 0; step < 3; ++step) {
    const auto report = many.advance(a, time_step);
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_TRUE(one.advance(b, time_step).converged);
  }
  EXPECT_GT(largest_value(parts, a.velocity_pressure), 1e-3);
  EXPECT_LE(test::difference(parts, a.velocity_pressure, whole, b.velocity_pressure, 0, 3), 1e-6);
  EXPECT_LE(test::difference(parts, a.velocity_pressure, whole, b.velocity_pressure, 3, 4), 1e-6);
  EXPECT_LE(test::difference(parts, a.acceleration, whole, b.acceleration, 0, 3), 1e-6);
  EXPECT_LE(test::difference(parts, a.displacement, whole, b.displacement, 0, 3), 1e-6);
  EXPECT_LE(test::difference(parts, a.displacement_rate, whole, b.displacement_rate, 0, 3), 1e-6);
  EXPECT_NEAR(a.outlets[0].flow(), b.outlets[0].flow(), 1e-6 * std::abs(b.outlets[0].flow()));
}

// All velocities of such a tetrahedron are prescribed, so that no equation has the pressure of its tip.
TEST(Problem, PressureOfATipBetweenRigidWallsIsThatBesideIt) {
  auto data = test::fluid_tube();
  const auto wall =
      std::find_if(data.faces.begin(), data.faces.end(), [](const auto& f) { return f.name == "lumen_wall"; });
  ASSERT_NE(wall, data.faces.end());
  const auto [a, b, c] = wall->triangles[wall->triangles.size() / 2];
  const auto tip = std::ssize(data.points);
  const auto normal = cross(data.points[b] - data.points[a], data.points[c] - data.points[a]);
  const Vec3<double> middle = (1.0 / 3) * (data.points[a] + data.points[b] + data.points[c]);
  data.points.push_back(middle + (1e-3 / norm(normal)) * normal);
  data.tetrahedra.push_back({a, b, c, tip});
  data.regions.back().end_element += 1;
  wall->triangles.erase(wall->triangles.begin() + std::ssize(wall->triangles) / 2);
  for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) wall->triangles.push_back({i, j, tip});
  mesh::add_edge_nodes(data);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  Problem problem(mesh, exact_flow_input());
  auto state = problem.initial_state();
  for (int step = 0; step < 2; ++step) {
    const auto report = problem.advance(state, time_step);
    ASSERT_TRUE(report.converged) << report.failure;
  }
  std::int64_t tips = 0;
  for (const auto& element : mesh.regions[0].elements)
    for (const auto node : element) {
      if (node >= mesh.owned_nodes || norm(mesh.points[node] - data.points[tip]) > 1e-9) continue;
      ++tips;
      double mean = 0;
      for (const auto other : element) mean += other == node ? 0 : state.velocity_pressure[at(other) + 3] / 3;
      EXPECT_NEAR(state.velocity_pressure[at(node) + 3], mean, 1e-12 * std::abs(mean));
      EXPECT_GT(std::abs(mean), 10.0);
    }
  EXPECT_EQ(parallel::global_sum(mesh.comm, tips), 1);
}

TEST(Problem, TwinsMoveWithTheirHostsAndTheInterfaceWithTheFlow) {
  const auto mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
  Problem problem(mesh, test::fsi_input(test::pressure(1000.0), test::pressure(0.0)));
  auto state = problem.initial_state();
  const auto scheme = assembly::TimeScheme::generalised_alpha(time_step, 0.5);
  for (int step = 0; step < 2; ++step) {
    const State old = state;
    const auto report = problem.advance(state, time_step);
    EXPECT_TRUE(report.converged) << report.failure;
    std::vector<char> in_wall(mesh.nodes(), 0);
    for (const auto& region : mesh.regions)
      for (const auto& element : region.elements)
        for (const auto node : element)
          if (region.kind == mesh::RegionKind::wall) in_wall[node] = in_wall[mesh.host[node]] = 1;
    double own_pressures = 0;
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      for (int c = 0; c < 3; ++c) {
        const auto k = at(i) + c, h = at(mesh.host[i]) + c;
        EXPECT_EQ(state.velocity_pressure[k], state.velocity_pressure[h]);
        EXPECT_EQ(state.acceleration[k], state.acceleration[h]);
        EXPECT_EQ(state.displacement[k], state.displacement[h]);
        EXPECT_EQ(state.displacement_rate[k], state.displacement_rate[h]);
        if (mesh.host[i] != i)
          own_pressures = std::max(own_pressures, std::abs(state.velocity_pressure[at(i) + 3] -
                                                           state.velocity_pressure[at(mesh.host[i]) + 3]));
        if (!in_wall[i]) continue;
        const double velocity = scheme.at_alpha_f(old.velocity_pressure[k], state.velocity_pressure[k]);
        EXPECT_NEAR(scheme.at_alpha_m(old.displacement_rate[k], state.displacement_rate[k]), velocity,
                    1e-12 * (std::abs(velocity) + 1e-3));
      }
    EXPECT_GT(parallel::global_max(MPI_COMM_WORLD, own_pressures), 1.0) << "pressure jumps across the interface";
  }
  EXPECT_GT(largest_value(mesh, state.displacement), 1e-8);
}

// With Newton's linear systems solved well, the residual falls quadratically until rounding: the tangent has all that
// the residual has. The stabilisation of the flow is held in the tangent, so that flow alone contracts linearly.
TEST(Problem, NewtonConvergesFast) {
  for (const auto element : {wall::Element::mixed, wall::Element::displacement}) {
    const auto mesh =
        distributed::distribute(mesh::box(3, 2, 2, {{0.03, 0.01, 0.01}}, mesh::RegionKind::wall), MPI_COMM_WORLD);
    Problem problem(mesh, bar_input(element, 1e5));
    auto state = problem.initial_state();
    const auto report = problem.advance(state, 2e-3);
    EXPECT_TRUE(report.converged) << report.failure;
    EXPECT_LE(report.iterations.size(), 5U);
    EXPECT_LE(report.final_norm, 1e-4 * report.iterations.back().norm) << "the last iteration is quadratic";
  }
  {
    const auto mesh = distributed::distribute(test::fluid_tube(), MPI_COMM_WORLD);
    Problem problem(mesh, exact_flow_input());
    auto state = problem.initial_state();
    for (int step = 0; step < 3; ++step) {
      const auto report = problem.advance(state, 2e-3);
      EXPECT_TRUE(report.converged) << report.failure;
      EXPECT_LE(report.iterations.size(), 6U);
    }
    EXPECT_GT(largest_value(mesh, state.velocity_pressure), 0.05);
  }
  {
    const auto mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
    auto input = test::fsi_input(test::pressure(1000.0), windkessel());
    input.newton.relative_tolerance = 1e-9;
    Problem problem(mesh, input);
    auto state = problem.initial_state();
    for (int step = 0; step < 2; ++step) {
      const auto report = problem.advance(state, time_step);
      EXPECT_TRUE(report.converged) << report.failure;
      EXPECT_LE(report.iterations.size(), 5U);
    }
  }
}

TEST(Problem, RejectedStepLeavesTheStateUntouched) {
  const auto mesh = distributed::distribute(test::fsi_tube(), MPI_COMM_WORLD);
  auto input = test::fsi_input(test::pressure(1000.0), windkessel());
  Problem sound(mesh, input);
  auto state = sound.initial_state();
  EXPECT_TRUE(sound.advance(state, time_step).converged);
  const State before = state;

  input.newton.max_iterations = 1;
  input.newton.relative_tolerance = 1e-13;
  Problem hasty(mesh, input);
  const auto unfinished = hasty.advance(state, time_step);
  EXPECT_FALSE(unfinished.converged);
  EXPECT_NE(unfinished.failure.find("did not converge in 1 iterations"), std::string::npos) << unfinished.failure;
  expect_same_bits(state, before);

  input = test::fsi_input(test::pressure(1e9), windkessel());
  Problem impossible(mesh, input);
  const auto spoilt = impossible.advance(state, 5e-3);
  EXPECT_FALSE(spoilt.converged);
  EXPECT_NE(spoilt.failure.find("the moving lumen mesh is spoilt: element"), std::string::npos) << spoilt.failure;
  expect_same_bits(state, before);
  const auto worst = impossible.worst_node();
  EXPECT_GT(worst.force, 0.0);

  // The state still leads where it led before.
  State again = before;
  EXPECT_TRUE(sound.advance(state, time_step).converged);
  EXPECT_TRUE(sound.advance(again, time_step).converged);
  expect_same_bits(state, again);
}

TEST(Problem, LinearSolverThatStopsEarlyIsReported) {
  const auto mesh = distributed::distribute(test::fluid_tube(), MPI_COMM_WORLD);
  auto input = exact_flow_input();
  input.linear.max_iterations = 1;
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  const auto before = state;
  const auto report = problem.advance(state, time_step);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.failure.find("linear solver stopped after 1 iterations"), std::string::npos) << report.failure;
  expect_same_bits(state, before);
}

TEST(Problem, StaticBarHasTheStretchOfUniaxialTension) {
  const Vec3<double> size{{0.03, 0.01, 0.01}};
  const double stress = 400.0;  // Pa, a thousandth of Young's modulus
  for (const auto element : {wall::Element::mixed, wall::Element::displacement}) {
    const auto mesh = distributed::distribute(mesh::box(3, 2, 2, size, mesh::RegionKind::wall), MPI_COMM_WORLD);
    const auto input = bar_input(element, stress);
    Problem problem(mesh, input);
    auto state = problem.initial_state();
    const double nu = element == wall::Element::mixed ? 0.45 : 0.3;
    for (const double factor : {1.0, 0.5}) {
      const auto report = problem.solve_static(state, factor);
      EXPECT_TRUE(report.converged) << report.failure;
      const double strain = 1e-3 * factor;
      for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
        const auto& x = mesh.points[i];
        EXPECT_NEAR(state.displacement[at(i)], strain * x[0], 3e-3 * strain * size[0]);
        EXPECT_NEAR(state.displacement[at(i) + 1], -nu * strain * x[1], 3e-3 * strain * size[0]);
        EXPECT_NEAR(state.displacement[at(i) + 2], -nu * strain * x[2], 3e-3 * strain * size[0]);
      }
    }
    EXPECT_EQ(largest_value(mesh, state.velocity_pressure), 0.0);
    EXPECT_EQ(state.time, 0.0);
  }
}

// A light bar under a growing pull: its stress is the pull of the instant at which forces balance, not made of the
// displacement at the end of the step and the pressure before it.
TEST(Problem, StressOfTheWallIsThatOfOneInstant) {
  constexpr double stress = 100.0, ramp = 10 * time_step;
  const auto mesh =
      distributed::distribute(mesh::box(2, 1, 1, {{0.02, 0.01, 0.01}}, mesh::RegionKind::wall), MPI_COMM_WORLD);
  auto input = bar_input(wall::Element::mixed, stress);
  input.wall->density = 1e-3;
  std::get<bc::Traction>(input.boundary.conditions[3].second).course.ramp_time = ramp;
  const auto scheme = assembly::TimeScheme::generalised_alpha(time_step, input.rho_infinity);
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  for (int step = 0; step < 4; ++step) {
    const auto report = problem.advance(state, time_step);
    ASSERT_TRUE(report.converged) << report.failure;
    const double pull = 0.5 * stress * (1 - std::cos(M_PI * (step + scheme.alpha_f) * time_step / ramp));
    const auto fields = problem.fields_with_pressure(state);
    for (std::int32_t e = 0; e < mesh.regions[0].owned_elements; ++e) {
      const auto sigma =
          cauchy_stress(problem.wall_model(), 0, e, wall_element(mesh, problem.wall_model(), fields, 0, e));
      EXPECT_NEAR(sigma[0], pull, 0.01 * pull) << step;
    }
  }
}

TEST(Problem, NodalForcesActLikeATractionAndThroughTwinsOnHosts) {
  const auto mesh =
      distributed::distribute(mesh::box(3, 2, 2, {{0.03, 0.01, 0.01}}, mesh::RegionKind::wall), MPI_COMM_WORLD);
  const double stress = 400.0;
  Problem pulled(mesh, bar_input(wall::Element::displacement, stress));
  Problem forced(mesh, bar_input(wall::Element::displacement, 0.0));
  std::vector<double> forces(at(mesh.nodes()), 0.0);
  for (const auto& triangle : mesh.face("x_max").triangles) {
    const Vec3<double> x[3] = {mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]};
    const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    for (const auto node : triangle) forces[at(node)] += stress * area / 3.0;
  }
  forced.set_nodal_forces(forces);
  auto a = pulled.initial_state(), b = forced.initial_state();
  EXPECT_TRUE(pulled.solve_static(a, 0.7).converged);
  EXPECT_TRUE(forced.solve_static(b, 0.7).converged);
  const double size = largest_value(mesh, a.displacement);
  EXPECT_GT(size, 0.0);
  for (std::size_t k = 0; k < a.displacement.size(); ++k)
    EXPECT_NEAR(a.displacement[k], b.displacement[k], 1e-7 * size);
  EXPECT_THROW(forced.set_nodal_forces(std::span(forces).first(4)), std::invalid_argument);
}

TEST_P(ProblemOfElements, PartialResidualsBalanceAtTheInterface) {
  const auto mesh = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_WORLD);
  auto input = test::fsi_input(test::pressure(1000.0), test::pressure(0.0));
  input.newton.relative_tolerance = 1e-9;
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  EXPECT_TRUE(problem.advance(state, time_step).converged);
  const auto parts = problem.partial_residuals();
  double sum = 0, size = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const auto& x = mesh.points[i];
    if (mesh.host[i] == i || x[2] < 1e-9 || x[2] > 0.03 - 1e-9) continue;  // the ends are held
    const auto host = at(mesh.host[i]);
    for (int c = 0; c < 3; ++c) {
      sum = std::max(sum, std::abs(parts.lumen[host + c] + parts.wall[host + c]));
      size = std::max(size, std::abs(parts.lumen[host + c]));
    }
  }
  sum = parallel::global_max(MPI_COMM_WORLD, sum);
  size = parallel::global_max(MPI_COMM_WORLD, size);
  EXPECT_GT(size, 0.0);
  EXPECT_LE(sum, 1e-6 * size);
}

TEST(Problem, RefusesPhysicsThatDoNotFitTheMesh) {
  const auto lumen = distributed::distribute(test::fluid_tube(), MPI_COMM_WORLD);
  auto input = exact_flow_input();
  input.fluid.reset();
  EXPECT_THROW(Problem(lumen, input), InputError);
  input = exact_flow_input();
  input.wall = test::soft_wall(wall::Element::mixed);
  EXPECT_THROW(Problem(lumen, input), InputError);
}

}  // namespace
}  // namespace tunica::coupling
