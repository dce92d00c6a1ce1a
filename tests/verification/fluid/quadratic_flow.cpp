// Quadratic velocity with linear pressure: what it has to reproduce exactly, and Poiseuille flow on the meshes on which
// linear elements fail.
#include "tube.hpp"
#include "tunica/coupling/monitors.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::verification {
namespace {

constexpr double mu = 0.004;

distributed::DistributedMesh quadratic(mesh::MeshData data) {
  mesh::add_edge_nodes(data);
  return distributed::distribute(data, MPI_COMM_WORLD);
}

// Between plates the flow v_z = C y (H - y), p = 2 mu C (L - z) is in the space of the elements: it is met up to the
// tolerance of Newton's method at any step, although every cell is crossed many times. The projection of convection is
// that of the start of a step, so that at steps of any size a wrong start is forgotten by about a quarter in each.
TEST(QuadraticFlow, PlanePoiseuilleFlowIsExact) {
  constexpr double height = 0.01, length = 0.02, c = 1e4;
  const auto mesh = quadratic(mesh::box(3, 3, 4, {{height, height, length}}, mesh::RegionKind::lumen));
  const auto velocity = [&](const Vec3<double>& x, double) { return Vec3<double>{{0, 0, c * x[1] * (height - x[1])}}; };
  const auto zero = [](const Vec3<double>&, double) { return Vec3<double>{}; };
  const auto pressure = [&](const Vec3<double>& x, double) { return 2 * mu * c * (length - x[2]); };
  auto input = newtonian(1060, mu);
  input.newton.relative_tolerance = 1e-9;
  input.rho_infinity = 0.0;
  for (const char* face : {"x_min", "x_max", "y_min", "y_max", "z_min"})
    input.boundary.velocity_fields.emplace_back(face, velocity);
  input.boundary.traction_fields.emplace_back("z_max", [&](const Vec3<double>& x, double) {
    return Vec3<double>{{0, mu * c * (height - 2 * x[1]), 0}};  // mu (grad v)^T n
  });
  for (const double dt : {1.0, 1e-3}) {
    coupling::Problem problem(mesh, input);
    auto state = state_from(problem, 0, velocity, zero, pressure);
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)  // a start that is wrong inside
      state.velocity_pressure[at(i)] += 0.01 * std::sin(1e3 * (mesh.points[i][0] + mesh.points[i][2]));
    ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, dt > 0.1 ? 100 : 5));
    const auto found = errors(problem, state, 0, velocity, pressure);
    const auto record = coupling::Monitors(problem).evaluate(dt);
    say("  step %g s: velocity %.1e, pressure %.1e, numerical over viscous dissipation %.1e\n", dt, found.velocity,
        found.pressure, record.numerical_dissipation / record.viscous_dissipation);
    if (dt < 0.1) continue;  // still decaying
    EXPECT_LT(found.velocity, 1e-11);
    EXPECT_LT(found.pressure, 1e-10);
    EXPECT_LT(std::abs(record.numerical_dissipation / record.viscous_dissipation), 1e-6);
    EXPECT_LT(std::abs(record.mass_residual / record.largest_flow), 1e-7);
  }
}

// Steps far below the time in which blood crosses an element, where pressure drives it in: a stabilisation that holds
// the rate cannot be solved there.
TEST(QuadraticFlow, SmallStepsWherePressureDrivesTheInflow) {
  const auto mesh =
      quadratic(mesh::tube({.radius = 5e-3, .length = 0.02, .cells_around = 8, .cells_radial = 1, .cells_along = 8}));
  auto input = newtonian(1000, 3e-3);
  input.boundary.conditions = {{"lumen_inlet", bc::Pressure{.pressure = {1333.0}}},
                               {"lumen_outlet", bc::Pressure{.pressure = {0.0}}},
                               {"lumen_wall", bc::NoSlip{}}};
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  int most = 0;
  for (int k = 0; k < 60; ++k) {
    const auto report = problem.advance(state, 1e-4);
    ASSERT_TRUE(report.converged) << "step " << k + 1 << ": " << report.failure;
    most = std::max(most, report.linear_iterations());
  }
  say("  60 steps of 0.1 ms: at most %d linear iterations in a step\n", most);
  EXPECT_LT(most, 100);
}

/// Slope of the pressure along a tube over that of the circle of the same volume.
double slope_in_tube(int around, int rings, double dt, int steps) {
  constexpr double radius = 3e-3, length = 12e-3, flow = 6e-6;
  constexpr int along = 8;
  const auto mesh = quadratic(mesh::tube(
      {.radius = radius, .length = length, .cells_around = around, .cells_radial = rings, .cells_along = along}));
  auto input = newtonian(1060, mu);
  input.boundary.conditions = {{"lumen_inlet", bc::Flow{.course = {flow}}},
                               {"lumen_outlet", bc::Pressure{.pressure = {0.0}}},
                               {"lumen_wall", bc::NoSlip{}}};
  coupling::Problem problem(mesh, input);
  auto state = problem.initial_state();
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(problem.advance(state, dt).converged);
  const double area = coupling::Monitors(problem).evaluate(dt).lumen_volume / length;
  const auto p = [&](double z) { return section_mean(mesh, state.velocity_pressure, 3, z); };
  const double slope = (p(length / 4) - p(3 * length / 4)) / (length / 2);
  return slope / (8 * pi * mu * flow / (area * area));
}

// Four elements across; linear elements are 2.8 and 4 times off on unstructured meshes of this size.
TEST(QuadraticFlow, PoiseuilleFlowWithFewElementsAcross) {
  const double coarse = slope_in_tube(12, 2, 5.2e-3, 60), small_step = slope_in_tube(12, 2, 1.3e-3, 240);
  say("  pressure gradient over that of the circle: %.4f at 5.2 ms, %.4f at 1.3 ms\n", coarse, small_step);
  EXPECT_NEAR(coarse, 1, 0.03);
  EXPECT_NEAR(small_step, coarse, 1e-3);
}

}  // namespace
}  // namespace tunica::verification
