// A flow that is prescribed at an opening passes it, however the opening moves.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "small_cases.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

constexpr double largest_flow = 1e-4, rise = 2e-2;

bc::Flow inflow() {
  return {.course = {.source = largest_flow, .ramp_time = rise}, .positive = bc::Flow::Sign::inflow};
}
double prescribed_at(double t) { return 0.5 * largest_flow * (1 - std::cos(std::numbers::pi * t / rise)); }

const FaceRecord& inlet(const StepRecord& record) {
  for (const auto& face : record.faces)
    if (face.name == "lumen_inlet") return face;
  throw std::logic_error("no inlet");
}

class MovingInflow : public testing::TestWithParam<bool> {};

/// Steps through the rise of the pulse; how much of the prescribed flow is wrong at most.
double largest_error(const distributed::DistributedMesh& mesh, ProblemInput input, int steps) {
  Problem problem(mesh, input);
  const Monitors monitors(problem);
  State state = problem.initial_state();
  const double dt = 1e-3, alpha = assembly::TimeScheme::generalised_alpha(dt, input.rho_infinity).alpha_f;
  double error = 0;
  for (int k = 0; k < steps; ++k) {
    const auto report = problem.advance(state, dt);
    EXPECT_TRUE(report.converged) << report.failure;
    const auto record = monitors.evaluate(dt);
    const double expected = -((1 - alpha) * prescribed_at(k * dt) + alpha * prescribed_at((k + 1) * dt));
    EXPECT_NEAR(*inlet(record).prescribed, expected, 1e-18);
    error = std::max(error, std::abs(inlet(record).flow / expected - 1));
    EXPECT_LT(std::abs(record.mass_residual), 1e-6 * record.largest_flow) << k;
  }
  return error;
}

// Its nodes slide outwards by different shares of the radius: area and profile both change.
TEST_P(MovingInflow, OfAMeshThatIsMoved) {
  auto data = test::fluid_tube();
  if (GetParam()) mesh::add_edge_nodes(data);
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  ProblemInput input;
  input.fluid = test::blood();
  input.boundary.fluid = input.fluid;
  input.boundary.conditions = {
      {"lumen_inlet", inflow()}, {"lumen_outlet", test::pressure(0)}, {"lumen_wall", bc::NoSlip{}}};
  input.mesh_displacement = [](const Vec3<double>& X, double t) {
    const double stretch = 20 * t * (1 + 1e4 * (X[0] * X[0] + X[1] * X[1]));
    return Vec3<double>{{stretch * X[0], 0.5 * stretch * X[1], 0}};
  };
  input.newton.relative_tolerance = input.linear.tolerance = input.linear.first_tolerance = 1e-8;
  EXPECT_LT(largest_error(mesh, input, 8), 1e-12);
}

TEST_P(MovingInflow, OfAMeshThatFollowsItsWall) {
  const auto mesh = distributed::distribute(test::fsi_tube(GetParam()), MPI_COMM_WORLD);
  auto input = test::fsi_input(inflow(), bc::Resistance{.resistance = 5e8});
  input.boundary.conditions[2].second = input.boundary.conditions[3].second =
      test::fixed_along_axes(false, false, true);
  EXPECT_LT(largest_error(mesh, input, 8), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Elements, MovingInflow, testing::Bool(),
                         [](const auto& element) { return element.param ? "quadratic" : "linear"; });

}  // namespace
}  // namespace tunica::coupling
