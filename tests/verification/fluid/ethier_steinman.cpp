// Ethier & Steinman 1994: an exact solution of the Navier-Stokes equations with all terms at work, on [-1, 1]^3 with
// a = pi/4, d = pi/2, rho = 1, mu = 1.
//
// The exact velocity is prescribed on five faces. On the sixth the exact traction acts: with velocities all around, the
// level of the pressure would be open, and the linear interpolants of the exact velocities would not balance.
#include "flow_case.hpp"
#include "tunica/mesh/edge_nodes.hpp"

namespace tunica::verification {
namespace {

constexpr double a = pi / 4, d = pi / 2, nu = 1.0;

struct Point {
  double x, y, z;
};
// The generated box starts in the origin.
Point from(const Vec3<double>& X) { return {X[0] - 1, X[1] - 1, X[2] - 1}; }

Vec3<double> shape(const Point& p) {
  const auto component = [](double x, double y, double z) {
    return -a * (std::exp(a * x) * std::sin(a * y + d * z) + std::exp(a * z) * std::cos(a * x + d * y));
  };
  return {{component(p.x, p.y, p.z), component(p.y, p.z, p.x), component(p.z, p.x, p.y)}};
}
Vec3<double> velocity(const Vec3<double>& X, double t) { return std::exp(-nu * d * d * t) * shape(from(X)); }
Vec3<double> rate(const Vec3<double>& X, double t) { return (-nu * d * d) * velocity(X, t); }
double pressure(const Vec3<double>& X, double t) {
  const auto [x, y, z] = from(X);
  const auto term = [](double r, double s, double q) {
    return std::exp(2 * a * r) + 2 * std::sin(a * r + d * s) * std::cos(a * q + d * r) * std::exp(a * (s + q));
  };
  return -0.5 * a * a * (term(x, y, z) + term(y, z, x) + term(z, x, y)) * std::exp(-2 * nu * d * d * t);
}
// sigma n on x = 1, n = (1, 0, 0): -p n + mu (dv/dx + grad v_x); derivatives by the formula.
Vec3<double> traction(const Vec3<double>& X, double t) {
  const auto [x, y, z] = from(X);
  const double decay = std::exp(-nu * d * d * t);
  const double e1 = std::exp(a * x), e2 = std::exp(a * y), e3 = std::exp(a * z);
  const double s1 = std::sin(a * x + d * y), c1 = std::cos(a * x + d * y);
  const double s2 = std::sin(a * y + d * z), c2 = std::cos(a * y + d * z);
  const double s3 = std::sin(a * z + d * x), c3 = std::cos(a * z + d * x);
  // u = -a (e1 s2 + e3 c1), v = -a (e2 s3 + e1 c2), w = -a (e3 s1 + e2 c3)
  const double u_x = -a * (a * e1 * s2 - a * e3 * s1), u_y = -a * (a * e1 * c2 - d * e3 * s1);
  const double u_z = -a * (d * e1 * c2 + a * e3 * c1);
  const double v_x = -a * (d * e2 * c3 + a * e1 * c2), w_x = -a * (a * e3 * c1 - d * e2 * s3);
  return {{-pressure(X, t) + 2 * nu * decay * u_x, nu * decay * (u_y + v_x), nu * decay * (u_z + w_x)}};
}

coupling::ProblemInput case_input() {
  auto input = newtonian(1.0, nu);
  input.fluid->backflow = 0.0;  // the exact traction is that of the flow, inward or not
  input.boundary.fluid = input.fluid;
  for (const char* face : {"x_min", "y_min", "y_max", "z_min", "z_max"})
    input.boundary.velocity_fields.emplace_back(face, velocity);
  input.boundary.traction_fields.emplace_back("x_max", traction);
  return input;
}

distributed::DistributedMesh cube(int n) {
  return distributed::distribute(mesh::box(n, n, n, {{2, 2, 2}}, mesh::RegionKind::lumen), MPI_COMM_WORLD);
}

TEST(EthierSteinman, OrdersInSpaceOfQuadraticElements) {
  constexpr double dt = 0.0025;
  auto input = case_input();
  input.newton.relative_tolerance = 1e-8;
  const double alpha_f = 1.0 / (1.0 + input.rho_infinity);
  std::vector<Errors> found;
  for (const int n : {3, 6, 12}) {
    auto data = mesh::box(n, n, n, {{2, 2, 2}}, mesh::RegionKind::lumen);
    mesh::add_edge_nodes(data);
    const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
    coupling::Problem problem(mesh, input);
    auto state = state_from(problem, 0, velocity, rate, pressure);
    ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, 10));
    found.push_back(errors(problem, state, state.time - (1 - alpha_f) * dt, velocity, pressure));
    say("  %2d^3 cells, quadratic: velocity %.3e  pressure %.3e", n, found.back().velocity, found.back().pressure);
    if (found.size() > 1) {
      const auto& coarse = found[found.size() - 2];
      say("  order %.2f %.2f", order(coarse.velocity, found.back().velocity),
          order(coarse.pressure, found.back().pressure));
    }
    say("\n");
  }
  EXPECT_GE(order(found[1].velocity, found[2].velocity), 2.7);
  EXPECT_GE(order(found[1].pressure, found[2].pressure), 1.7);
}

TEST(EthierSteinman, OrdersInSpace) {
  constexpr double dt = 0.01;
  const auto input = case_input();
  const double alpha_f = 1.0 / (1.0 + input.rho_infinity);
  std::vector<Errors> found;
  for (const int n : {5, 10, 20}) {
    const auto mesh = cube(n);
    coupling::Problem problem(mesh, input);
    auto state = state_from(problem, 0, velocity, rate, pressure);
    ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, 10));
    found.push_back(errors(problem, state, state.time - (1 - alpha_f) * dt, velocity, pressure));
    say("  %2d^3 cells: velocity %.3e  pressure %.3e", n, found.back().velocity, found.back().pressure);
    if (found.size() > 1) {
      const auto& coarse = found[found.size() - 2];
      say("  order %.2f %.2f", order(coarse.velocity, found.back().velocity),
          order(coarse.pressure, found.back().pressure));
    }
    say("\n");
  }
  EXPECT_GE(order(found[1].velocity, found[2].velocity), 1.9);
  EXPECT_GE(order(found[1].pressure, found[2].pressure), 1.0);
  EXPECT_LT(found[2].velocity, 0.01);
}

// The stabilisation parameters contain the step size, so the semi-discrete problem would change with it: c_M goes with
// dt here, which keeps 4 c_M^2 / dt^2 as it is. All runs start from a state that a run with small steps has reached, so
// that velocity and acceleration fit the discrete equations.
struct TimeErrors {
  double velocity = 0, pressure = 0;
};

TimeErrors time_error(const distributed::DistributedMesh& mesh, const coupling::ProblemInput& base, double dt,
                      double end, const coupling::State& start, const coupling::State& last,
                      const std::vector<std::vector<double>>& pressures, double reference_dt) {
  auto input = base;
  input.fluid->c_m = base.fluid->c_m * dt / reference_dt;
  input.boundary.fluid = input.fluid;
  coupling::Problem problem(mesh, input);
  auto state = start;
  const double alpha_f = 1.0 / (1.0 + input.rho_infinity);
  march(problem, state, dt, static_cast<int>(std::lround((end - start.time) / dt)));
  // Pressure k of the reference belongs to start + (k + alpha_f) reference_dt.
  const double place = (state.time - (1 - alpha_f) * dt - start.time) / reference_dt - alpha_f;
  const std::size_t k = std::min(static_cast<std::size_t>(place), pressures.size() - 2);
  const double s = place - static_cast<double>(k);
  std::vector<double> sums(4, 0.0);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    for (int c = 0; c < 3; ++c) {
      const double exact = last.velocity_pressure[at(i) + c], error = state.velocity_pressure[at(i) + c] - exact;
      sums[0] += error * error;
      sums[1] += exact * exact;
    }
    const double exact = (1 - s) * pressures[k][i] + s * pressures[k + 1][i];
    const double error = state.velocity_pressure[at(i) + 3] - exact;
    sums[2] += error * error;
    sums[3] += exact * exact;
  }
  parallel::global_sum(mesh.comm, sums);
  return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

void check_order_in_time(coupling::ProblemInput input) {
  constexpr double reference_dt = 0.0025, begin = 0.04, end = 0.28;
  input.newton.relative_tolerance = 1e-9;
  const auto mesh = cube(6);
  coupling::Problem problem(mesh, input);
  auto state = state_from(problem, 0, velocity, rate, pressure);
  if (input.mesh_displacement) {  // starts from rest with zero rate
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      const auto u = input.mesh_displacement(mesh.points[i], 0.0);
      ASSERT_EQ(dot(u, u), 0.0);
    }
  }
  ASSERT_NO_FATAL_FAILURE(march(problem, state, reference_dt, static_cast<int>(std::lround(begin / reference_dt))));
  const auto start = state;
  std::vector<std::vector<double>> pressures;
  ASSERT_NO_FATAL_FAILURE(
      march(problem, state, reference_dt, static_cast<int>(std::lround((end - begin) / reference_dt)), [&] {
        auto& p = pressures.emplace_back(mesh.owned_nodes);
        for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) p[i] = state.velocity_pressure[at(i) + 3];
      }));
  std::vector<TimeErrors> found;
  for (const double dt : {0.08, 0.04, 0.02}) {
    found.push_back(time_error(mesh, input, dt, end, start, state, pressures, reference_dt));
    say("  dt %.3f s: velocity %.3e  pressure %.3e", dt, found.back().velocity, found.back().pressure);
    if (found.size() > 1) {
      const auto& coarse = found[found.size() - 2];
      say("  order %.2f %.2f", order(coarse.velocity, found.back().velocity),
          order(coarse.pressure, found.back().pressure));
    }
    say("\n");
  }
  EXPECT_GE(order(found[1].velocity, found[2].velocity), 1.9);
  EXPECT_GE(order(found[1].pressure, found[2].pressure), 1.85);
}

TEST(EthierSteinman, OrderInTime) { check_order_in_time(case_input()); }

// The same flow seen from a mesh whose inner nodes swing: mesh velocity and position enter at their instants.
TEST(EthierSteinman, OrderInTimeOnAMovingMesh) {
  auto input = case_input();
  input.mesh_displacement = [](const Vec3<double>& X, double t) {
    const double bump = std::sin(pi * X[0] / 2) * std::sin(pi * X[1] / 2) * std::sin(pi * X[2] / 2);
    const double swing = 0.15 * bump * (1 - std::cos(2 * pi * t / 0.3));
    const bool boundary = X[0] <= 0 || X[0] >= 2 || X[1] <= 0 || X[1] >= 2 || X[2] <= 0 || X[2] >= 2;
    return boundary ? Vec3<double>{} : Vec3<double>{{swing, -0.5 * swing, 0.7 * swing}};
  };
  check_order_in_time(input);
}

}  // namespace
}  // namespace tunica::verification
