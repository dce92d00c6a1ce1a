// Womersley 1955: flow in a rigid round tube under an oscillating pressure difference between its ends, at a Womersley
// number of 12.9. Starts from the exact solution and is compared with it in the second half of the period.
#include <complex>

#include "tube.hpp"

namespace tunica::verification {
namespace {

constexpr double radius = 0.01, length = 0.02, density = 1060, mu = 0.004, period = 1, gradient = 100;
constexpr double omega = 2 * pi / period;
using Complex = std::complex<double>;

// J0 by its power series; |z| stays below 13, where double leaves nine digits.
Complex bessel_j0(Complex z) {
  Complex term = 1, sum = 1;
  for (int k = 1; k < 80; ++k) {
    term *= -z * z / (4.0 * k * k);
    sum += term;
  }
  return sum;
}

// -dp/dz = gradient cos(omega t): u = Re{gradient / (i omega rho) (1 - J0(Lambda r/R) / J0(Lambda)) exp(i omega t)}
Complex amplitude(double r) {
  static const Complex lambda = radius * std::sqrt(density * omega / mu) * std::exp(Complex(0, 0.75 * pi));
  const Complex ratio = bessel_j0(lambda * (std::min(r, radius) / radius)) / bessel_j0(lambda);
  return gradient / Complex(0, omega * density) * (1.0 - ratio);
}
Vec3<double> exact(const Vec3<double>& X, double t) {
  return {{0, 0, std::real(amplitude(radius_of(X)) * std::exp(Complex(0, omega * t)))}};
}
Vec3<double> exact_rate(const Vec3<double>& X, double t) {
  return {{0, 0, std::real(Complex(0, omega) * amplitude(radius_of(X)) * std::exp(Complex(0, omega * t)))}};
}

TEST(Womersley, RigidTube) {
  const auto file = reference("womersley_rigid.csv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data";
  const auto profile = read_columns(file);
  const std::vector<std::pair<double, std::string>> instants = {{0.0, "u_cm_s_t=0"},
                                                                {0.125, "u_cm_s_t=0.125"},
                                                                {0.25, "u_cm_s_t=0.25"},
                                                                {0.375, "u_cm_s_t=0.375"},
                                                                {0.5, "u_cm_s_t=0.5"}};
  for (const auto& [t, column] : instants)
    for (std::size_t k = 0; k < profile["r_over_R"].size(); ++k)
      ASSERT_NEAR(exact({{profile["r_over_R"][k] * radius, 0, 0}}, t)[2], 0.01 * profile[column][k], 1e-8);

  constexpr int around = 64, rings = 20, along = 4;
  const auto grade = [](double r) { return r * (1.6 - 0.6 * r); };  // finer towards the wall
  const auto mesh = distributed::distribute(
      graded_tube(
          {.radius = radius, .length = length, .cells_around = around, .cells_radial = rings, .cells_along = along},
          grade),
      MPI_COMM_WORLD);
  auto input = newtonian(density, mu);
  input.fluid->backflow = 0;  // the pressure acts alone, also where the flow enters
  input.boundary.fluid = input.fluid;
  input.boundary.conditions = {{"lumen_wall", bc::NoSlip{}}, {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}}};
  input.boundary.traction_fields.emplace_back("lumen_inlet", [](const Vec3<double>&, double t) {
    return Vec3<double>{{0, 0, gradient * length * std::cos(omega * t)}};
  });
  input.newton.relative_tolerance = 1e-5;
  coupling::Problem problem(mesh, input);
  auto state = state_from(problem, 0, exact, exact_rate, [](const Vec3<double>& X, double t) {
    return gradient * (length - X[2]) * std::cos(omega * t);
  });
  double peak = 0;
  for (const auto& [t, column] : instants)
    for (const double u : profile[column]) peak = std::max(peak, std::abs(0.01 * u));

  constexpr double dt = 0.0125;
  for (const double t : {0.5, 0.625, 0.75, 0.875, 1.0}) {
    ASSERT_NO_FATAL_FAILURE(march(problem, state, dt, static_cast<int>(std::lround((t - state.time) / dt))));
    double worst = 0, square = 0, count = 0;
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      if (std::abs(mesh.points[i][2] - 0.5 * length) > 1e-9) continue;
      const double error = state.velocity_pressure[at(i) + 2] - exact(mesh.points[i], t)[2];
      worst = std::max(worst, std::abs(error));
      square += error * error;
      count += 1;
    }
    worst = parallel::global_max(mesh.comm, worst);
    const double rms = std::sqrt(parallel::global_sum(mesh.comm, square) / parallel::global_sum(mesh.comm, count));
    say("  t = %.3f s: largest deviation %.2f %% of the peak velocity, rms %.2f %%\n", t, 100 * worst / peak,
        100 * rms / peak);
    EXPECT_LT(worst / peak, 0.01);
  }
}

}  // namespace
}  // namespace tunica::verification
