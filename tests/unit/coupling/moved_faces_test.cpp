#include "tunica/coupling/moved_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "small_cases.hpp"
#include "temporary_folder.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

using test::at;

constexpr double step_size = 2e-4;  // s

distributed::DistributedMesh bar() {
  return distributed::distribute(mesh::box(3, 2, 2, {{0.03, 0.01, 0.01}}, mesh::RegionKind::wall), MPI_COMM_WORLD);
}

/// A bar between planes of symmetry; `end`: what happens at x_max.
ProblemInput bar_input(bc::Condition end) {
  ProblemInput in;
  in.wall = test::soft_wall(wall::Element::displacement);
  in.boundary.wall_has_pressure = false;
  in.boundary.conditions = {{"x_min", test::fixed_along_axes(true, false, false)},
                            {"y_min", test::fixed_along_axes(false, true, false)},
                            {"z_min", test::fixed_along_axes(false, false, true)},
                            {"x_max", std::move(end)},
                            {"y_max", bc::Free{}},
                            {"z_max", bc::Free{}}};
  in.newton.relative_tolerance = 1e-9;
  in.linear.tolerance = in.linear.first_tolerance = 1e-8;
  return in;
}

TEST(MovedFaces, StretchAStaticBarEvenly) {
  const auto mesh = bar();
  Problem problem(mesh, bar_input(bc::Displacement{.value = {{0.003, 0, 0}}, .directions = {true, false, false}}));
  auto state = problem.initial_state();
  for (const double factor : {0.5, 1.0}) {
    const auto report = problem.solve_static(state, factor);
    ASSERT_TRUE(report.converged) << report.failure;
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      EXPECT_NEAR(state.displacement[at(i)], 0.1 * factor * mesh.points[i][0], 1e-8);
  }
  double across = 0;
  for (std::size_t k = 1; k < state.displacement.size(); k += 4) across = std::min(across, state.displacement[k]);
  EXPECT_LT(parallel::global_min(MPI_COMM_WORLD, across), -1e-4) << "free across: the bar gets thinner";
}

TEST(MovedFaces, FollowTheirCourseInTime) {
  const auto mesh = bar();
  const bc::Displacement moved{.value = {{2e-4, 1e-4, 0}}, .course = {.source = 1.0, .ramp_time = 10 * step_size}};
  auto input = bar_input(moved);
  input.boundary.conditions[1].second = bc::Free{};
  input.boundary.conditions[0].second = bc::Fixed{};
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  for (int step = 1; step <= 12; ++step) {
    const auto report = problem.advance(state, step_size);
    ASSERT_TRUE(report.converged) << report.failure;
    const double course = step < 10 ? 0.5 * (1 - std::cos(M_PI * step / 10)) : 1.0;
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      if (mesh.points[i][0] < 0.0299) continue;
      // z_min holds its nodes along z, which the face moves by nothing.
      EXPECT_NEAR(state.displacement[at(i)], 2e-4 * course, 1e-12) << step;
      EXPECT_NEAR(state.displacement[at(i) + 1], 1e-4 * course, 1e-12) << step;
      EXPECT_NEAR(state.displacement[at(i) + 2], 0, 1e-12) << step;
    }
  }
}

TEST(MovedFaces, WhatOthersFixStaysAtRest) {
  const auto mesh = bar();
  auto input = bar_input(bc::Displacement{.value = {{0.001, 0.001, 0}}, .directions = {true, true, false}});
  const MovedFaces faces(mesh, input.boundary.conditions);
  int along_y = 0;
  faces.at(0.0, [&](std::int32_t node, int axis, double displacement) {
    EXPECT_GT(mesh.points[node][0], 0.0299);
    EXPECT_NE(axis, 2);
    EXPECT_EQ(displacement, 0.001);
    if (axis != 1) return;
    EXPECT_GT(mesh.points[node][1], 1e-9) << "y_min is fixed along y";
    ++along_y;
  });
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, static_cast<std::int64_t>(along_y)), 0);
}

TEST(MovedFaces, FollowATableInTime) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "moved.csv") << "t,x,y,z,ux,uy,uz\n0,3,0,0,0,0,0\n0,3,1,0,0,0,0\n0,3,0,1,0,0,0\n"
                                                "2,3,0,0,1,0,0\n2,3,1,0,2,0,0\n2,3,0,1,1,0,0\n";
  const auto mesh = bar();
  // u_x = t/2 (1 + y / cm) mm
  const MovedFaces faces(
      mesh,
      bar_input(bc::Displacement{
                    .course = {2.0},
                    .directions = {true, false, false},
                    .over_face = bc::OverFace{.table = folder.path() / "moved.csv", .unit = 1e-3, .length_unit = 0.01}})
          .boundary.conditions);
  std::int64_t seen = 0;
  faces.at(1.5, [&](std::int32_t node, int axis, double displacement) {
    EXPECT_EQ(axis, 0);
    EXPECT_NEAR(displacement, 2 * 0.75e-3 * (1 + 100 * mesh.points[node][1]), 1e-9);
    ++seen;
  });
  EXPECT_GT(parallel::global_sum(MPI_COMM_WORLD, seen), 0);
}

TEST(LoadedFaces, AreHeldAlongAxesUnderTheLoad) {
  const auto mesh = bar();
  for (const bool traction : {false, true}) {
    bc::Condition load = bc::Pressure{.pressure = {-4e4}, .follower = false, .fixed = {false, true, true}};
    if (traction) load = bc::Traction{.vector = {{4e4, 0, 0}}, .fixed = {false, true, true}};
    Problem problem(mesh, bar_input(load));
    auto state = problem.initial_state();
    const auto report = problem.solve_static(state, 1.0);
    ASSERT_TRUE(report.converged) << report.failure;
    double thinner = 0;
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      if (mesh.points[i][0] > 0.0299) {
        EXPECT_EQ(state.displacement[at(i) + 1], 0.0);
        EXPECT_EQ(state.displacement[at(i) + 2], 0.0);
        EXPECT_GT(state.displacement[at(i)], 1e-3);
      }
      thinner = std::min(thinner, state.displacement[at(i) + 1]);
    }
    EXPECT_LT(parallel::global_min(MPI_COMM_WORLD, thinner), -1e-4);
  }
}

// Blood that a pressure pushes as a plug between planes of symmetry: the pressure falls evenly to zero at every
// instant. At the ends of steps it is found with second order, that of the balance stands for another instant.
TEST(EndPressure, IsThatOfTheEndOfTheStep) {
  constexpr double ramp = 0.02, height = 1000.0;
  const auto mesh =
      distributed::distribute(mesh::box(2, 1, 1, {{0.02, 0.01, 0.01}}, mesh::RegionKind::lumen), MPI_COMM_WORLD);
  ProblemInput input;
  input.fluid = test::blood();
  input.fluid->backflow = 0;  // the pressure acts alone where the flow enters
  input.boundary.fluid = input.fluid;
  input.boundary.conditions = {{"x_min", bc::Pressure{.pressure = {.source = height, .ramp_time = ramp}}},
                               {"x_max", test::pressure(0.0)},
                               {"y_min", bc::Symmetry{}},
                               {"y_max", bc::Symmetry{}},
                               {"z_min", bc::Symmetry{}},
                               {"z_max", bc::Symmetry{}}};
  input.newton.relative_tolerance = 1e-10;
  input.linear.tolerance = input.linear.first_tolerance = 1e-8;
  const auto error = [&](int steps, bool at_end) {
    Problem problem(mesh, input);
    auto state = problem.initial_state();
    double largest = 0;
    for (int step = 1; step <= steps; ++step) {
      EXPECT_TRUE(problem.advance(state, 0.5 * ramp / steps).converged);
      const double exact = 0.25 * height * (1 - std::cos(M_PI * state.time / ramp));
      const State shown = at_end ? with_end_pressure(state) : state;
      for (std::int32_t i = 0; i < mesh.nodes(); ++i)
        if (std::abs(mesh.points[i][0] - 0.01) < 1e-6)
          largest = std::max(largest, std::abs(shown.velocity_pressure[at(i) + 3] - exact));
    }
    return parallel::global_max(MPI_COMM_WORLD, largest);
  };
  EXPECT_NEAR(std::log2(error(10, true) / error(20, true)), 2.0, 0.15);
  EXPECT_LT(error(20, true), 2e-3 * height);
  EXPECT_NEAR(std::log2(error(10, false) / error(20, false)), 1.0, 0.15);
}

}  // namespace
}  // namespace tunica::coupling
