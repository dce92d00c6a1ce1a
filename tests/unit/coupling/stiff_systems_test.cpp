// Linear iterations where preconditioners fail: walls that are stiff against their inertia, and outlets of large
// resistance. The bounds are a fifth to a half above what one to three ranks took.
#include <gtest/gtest.h>

#include <algorithm>

#include "small_cases.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

/// Most linear iterations of a solve.
int most(const StepReport& report) {
  EXPECT_TRUE(report.converged) << report.failure;
  int result = 0;
  for (const auto& i : report.iterations) result = std::max(result, i.linear_iterations);
  return result;
}

int most_of_inflation(wall::Element element, bool quadratic) {
  auto data = mesh::thick_cylinder(
      {.inner = 0.01, .outer = 0.012, .length = 0.06, .cells_radial = 1, .cells_around = 16, .cells_along = 16},
      mesh::Sector::full);
  if (quadratic) mesh::add_edge_nodes(data);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  ProblemInput input;
  input.wall = test::soft_wall(element);
  input.boundary.wall_has_pressure = element == wall::Element::mixed;
  const auto held = test::fixed_along_axes(true, true, true);
  input.boundary.conditions = {
      {"wall_inner", test::pressure(1e3)}, {"wall_outer", bc::Free{}}, {"wall_inlet", held}, {"wall_outlet", held}};
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  return most(problem.solve_static(state, 1.0));
}

TEST(StiffSystems, WallAloneInStatics) {
  EXPECT_LE(most_of_inflation(wall::Element::mixed, true), 30);
  EXPECT_LE(most_of_inflation(wall::Element::displacement, true), 60);
  EXPECT_LE(most_of_inflation(wall::Element::mixed, false), 30);
  EXPECT_LE(most_of_inflation(wall::Element::displacement, false), 30);
}

/// Of the second step, in a compliant tube of quadratic elements.
int most_in_tube(double dt, double resistance) {
  auto data = test::fsi_tube(true);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  auto input = test::fsi_input(test::pressure(500.0), bc::Resistance{resistance});
  input.linear = {};
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  most(problem.advance(state, dt));
  return most(problem.advance(state, dt));
}

TEST(StiffSystems, CompliantTubeAtAnyStep) {
  for (const double dt : {1e-4, 1e-3, 5e-3, 1e-2}) EXPECT_LE(most_in_tube(dt, 1e7), 60) << dt;
}

TEST(StiffSystems, OutletsOfAnyResistance) {
  for (const double resistance : {1e6, 1e8, 1e10}) EXPECT_LE(most_in_tube(5e-3, resistance), 60) << resistance;
}

}  // namespace
}  // namespace tunica::coupling
