#include "tunica/coupling/monitors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tunica/mesh/generate.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

constexpr mesh::TubeSizes sizes{.radius = 0.005,
                                .length = 0.02,
                                .wall_thickness = 0.001,
                                .cells_around = 8,
                                .cells_radial = 1,
                                .cells_along = 5,
                                .cells_through_wall = 1};
// Area of the regular octagon in the circle.
const double octagon = 2 * std::numbers::sqrt2 * sizes.radius * sizes.radius;

ProblemInput flow_input() {
  ProblemInput in;
  in.fluid = fluid::Parameters{.density = 1000, .viscosity = fluid::Newtonian{0.004}};
  in.boundary.fluid = in.fluid;
  in.newton.relative_tolerance = 1e-8;
  in.linear.tolerance = in.linear.first_tolerance = 1e-6;
  return in;
}

ProblemInput coupled_input(wall::Element element) {
  ProblemInput in = flow_input();
  in.wall = wall::Parameters{};
  in.wall->element = element;
  in.wall->density = 1200;
  auto& law = std::get<wall::NeoHookeParameters>(in.wall->material);
  law.elastic.young_modulus = 3e5;
  law.elastic.poisson_ratio = 0.3;
  in.boundary.wall_has_pressure = element == wall::Element::mixed;
  in.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  in.boundary.conditions = {{"lumen_inlet", bc::Pressure{bc::WaveformInput{1000.0}}},
                            {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}},
                            {"wall_inlet", bc::Fixed{}},
                            {"wall_outlet", bc::Fixed{}},
                            {"wall_outer", bc::Free{}}};
  return in;
}

const FaceRecord& face(const StepRecord& record, const std::string& name) {
  for (const auto& f : record.faces)
    if (f.name == name) return f;
  throw std::runtime_error("no face " + name);
}

TEST(Monitors, RigidTube) {
  mesh::TubeSizes lumen = sizes;
  lumen.wall_thickness = 0;
  const auto mesh = distributed::distribute(mesh::tube(lumen), MPI_COMM_WORLD);
  ProblemInput in = flow_input();
  const double Q = 2e-5;
  in.boundary.conditions = {
      {"lumen_inlet", bc::Flow{.course = bc::WaveformInput{Q}, .positive = bc::Flow::Sign::inflow}},
      {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}},
      {"lumen_wall", bc::NoSlip{}}};
  in.rho_infinity = 0.5;  // alpha_f = 2/3
  Problem problem(mesh, in);
  State state = problem.initial_state();
  const Monitors monitors(problem);
  for (int step = 0; step < 2; ++step) ASSERT_TRUE(problem.advance(state, 1e-3).converged);
  const StepRecord r = monitors.evaluate(1e-3);

  ASSERT_EQ(r.faces.size(), 3u);
  EXPECT_NEAR(face(r, "lumen_inlet").flow, -Q, 1e-12 * Q);
  EXPECT_NEAR(face(r, "lumen_outlet").flow, Q, 1e-6 * Q);
  EXPECT_NEAR(face(r, "lumen_wall").flow, 0, 1e-16 * Q);
  EXPECT_NEAR(r.mass_residual, face(r, "lumen_inlet").flow + face(r, "lumen_outlet").flow, 1e-15 * Q);
  EXPECT_NEAR(face(r, "lumen_inlet").area, octagon, 1e-12 * octagon);
  EXPECT_NEAR(r.lumen_volume, octagon * lumen.length, 1e-12 * octagon * lumen.length);
  EXPECT_EQ(r.volume_rate, 0);
  EXPECT_NEAR(r.largest_flow, Q, 1e-6 * Q);
  EXPECT_EQ(r.wall_volume + r.wall_kinetic + r.wall_strain + r.max_displacement, 0);
  EXPECT_EQ(r.mesh_quality, 1);
  EXPECT_GT(r.fluid_kinetic, 0.5 * 1000 * r.lumen_volume * std::pow(Q / octagon, 2));  // that of a plug
  EXPECT_GT(r.viscous_dissipation, 0);
  EXPECT_GT(r.max_velocity, 1.5 * Q / octagon);
}

TEST(Monitors, FluidAtRestHasThePressureOfItsEnds) {
  mesh::TubeSizes lumen = sizes;
  lumen.wall_thickness = 0;
  const auto mesh = distributed::distribute(mesh::tube(lumen), MPI_COMM_WORLD);
  ProblemInput in = flow_input();
  const bc::Pressure pressure{bc::WaveformInput{500.0}};
  in.boundary.conditions = {{"lumen_inlet", pressure}, {"lumen_outlet", pressure}, {"lumen_wall", bc::NoSlip{}}};
  Problem problem(mesh, in);
  State state = problem.initial_state();
  ASSERT_TRUE(problem.advance(state, 1e-3).converged);
  const StepRecord r = Monitors(problem).evaluate(1e-3);
  for (const auto& f : r.faces) EXPECT_NEAR(f.mean_pressure, 500, 1e-4) << f.name;
  EXPECT_LT(r.max_velocity, 1e-6);
}

class CoupledMonitors : public testing::TestWithParam<wall::Element> {};

// Balances that hold to the tolerance of Newton's method, and those that hold to the accuracy of the time step.
TEST_P(CoupledMonitors, BalancesClose) {
  const auto mesh = distributed::distribute(mesh::tube(sizes), MPI_COMM_WORLD);
  Problem problem(mesh, coupled_input(GetParam()));
  State state = problem.initial_state();
  const Monitors monitors(problem);
  const double dt = 2e-5;
  StepRecord before;
  for (int step = 0; step < 20; ++step) {
    ASSERT_TRUE(problem.advance(state, dt).converged);
    const StepRecord r = monitors.evaluate(dt);
    EXPECT_LT(std::abs(r.mass_residual), 1e-7 * r.largest_flow) << step;
    EXPECT_LT(std::abs(r.interface_power_lumen + r.interface_power_wall), 1e-6 * std::abs(r.interface_power_wall))
        << step;
    EXPECT_NEAR(face(r, "lumen_wall").flow, 0, 1e-12 * r.largest_flow);  // nothing passes the wall
    if (step >= 10) {
      const auto mean = [&](double StepRecord::*q) { return 0.5 * (before.*q + r.*q); };
      const auto rate = [&](double StepRecord::*q) { return (r.*q - before.*q) / dt; };
      EXPECT_NEAR(rate(&StepRecord::lumen_volume), mean(&StepRecord::volume_rate), 0.002 * r.volume_rate) << step;
      const double supplied = mean(&StepRecord::opening_power) + mean(&StepRecord::interface_power_lumen);
      EXPECT_NEAR(rate(&StepRecord::fluid_kinetic) + mean(&StepRecord::viscous_dissipation) +
                      mean(&StepRecord::numerical_dissipation),
                  supplied, 0.02 * r.opening_power)
          << step;
      EXPECT_NEAR(rate(&StepRecord::wall_kinetic) + rate(&StepRecord::wall_strain),
                  mean(&StepRecord::interface_power_wall) + mean(&StepRecord::wall_load_power), 0.02 * r.opening_power)
          << step;
    }
    before = r;
  }
  EXPECT_GT(before.max_displacement, 0);
  EXPECT_LT(before.mesh_quality, 1);
}

INSTANTIATE_TEST_SUITE_P(Elements, CoupledMonitors, testing::Values(wall::Element::mixed, wall::Element::displacement));

}  // namespace
}  // namespace tunica::coupling
