// Steady flow in a round tube: the pressure gradient is 8 mu Q / (pi R^4). Prescribed flow with a parabolic profile
// enters, a resistance holds the outlet at R Q.
#include "tube.hpp"

namespace tunica::verification {
namespace {

constexpr double radius = 0.01, length = 0.03, flow = 2e-5, mu = 0.004, resistance = 1e7;

struct Found {
  double gradient = 0, outlet = 0;  ///< deviations relative to the exact values
};

Found measure(int around, int rings, int along) {
  const auto mesh = distributed::distribute(
      mesh::tube(
          {.radius = radius, .length = length, .cells_around = around, .cells_radial = rings, .cells_along = along}),
      MPI_COMM_WORLD);
  auto input = newtonian(1060, mu);
  input.boundary.conditions = {{"lumen_inlet", bc::Flow{.course = {flow}}},
                               {"lumen_outlet", bc::Resistance{.resistance = resistance}},
                               {"lumen_wall", bc::NoSlip{}}};
  input.rho_infinity = 0.0;
  input.newton.relative_tolerance = 1e-7;
  input.newton.reference_fraction = 1;
  coupling::Problem problem(mesh, input);
  const double mean = flow / (pi * radius * radius);
  const auto profile = [&](const Vec3<double>& X, double) {
    return Vec3<double>{{0, 0, 2 * mean * (1 - std::pow(radius_of(X) / radius, 2))}};
  };
  const double slope = 8 * mu * flow / (pi * std::pow(radius, 4));
  auto state = state_from(
      problem, 0, profile, [](const Vec3<double>&, double) { return Vec3<double>{}; },
      [&](const Vec3<double>& X, double) { return resistance * flow + slope * (length - X[2]); });
  state.outlets[0].set_initial_flow(flow);
  state.residual_reference = slope * length * pi * radius * radius;
  for (const double dt : {1.0, 10.0, 100.0, 100.0}) march(problem, state, dt, 1);
  const auto& f = state.velocity_pressure;
  // Slope of the straight line through the middle half: near a prescribed velocity the stabilisation bends the
  // pressure, and at the outlet, where only a normal traction acts, the flow spreads.
  double zz = 0, zp = 0;
  for (int k = along / 4; k <= along - along / 4; ++k) {
    const double z = length * (static_cast<double>(k) / along - 0.5);
    zz += z * z;
    zp -= z * section_mean(mesh, f, 3, length * k / along);
  }
  return {zp / zz / slope - 1, face_pressure(mesh, "lumen_outlet", f.data()) / (resistance * flow) - 1};
}

TEST(Poiseuille, PressureDropAndItsOrder) {
  std::vector<Found> found;
  for (const int k : {2, 3, 4}) {
    found.push_back(measure(8 * k, 2 * k, 6 * k));
    say("  %2d cells around, %2d over the radius: pressure gradient %+.2f %%, mean pressure of the outlet %+.1e", 8 * k,
        3 * k, 100 * found.back().gradient, found.back().outlet);
    if (k > 2) {
      const auto& coarse = found[found.size() - 2];
      say("  order %.2f", order(std::abs(coarse.gradient), std::abs(found.back().gradient), k / (k - 1.0)));
    }
    say("\n");
  }
  EXPECT_GE(order(std::abs(found[0].gradient), std::abs(found[2].gradient), 2), 1.8);
  EXPECT_LT(std::abs(found[2].gradient), 0.01);
  EXPECT_LT(std::abs(found[2].outlet), 0.001);
}

}  // namespace
}  // namespace tunica::verification
