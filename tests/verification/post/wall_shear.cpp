// Wall shear stress as `tunica post` finds it, from cases that `tunica run` computes: steady and oscillating flow in a
// round tube. Velocities are linear in each element, so that the stress at the wall is that at half the height of the
// first element: it converges with the first power of the mesh size.
#include <fmt/format.h>

#include <complex>

#include "run_and_post.hpp"
#include "verification/fluid/flow_case.hpp"

namespace tunica::verification {
namespace {

using Complex = std::complex<double>;
constexpr double mu = 0.004, density = 1060;

std::string tube(double radius, double length, int k, int along) {
  return fmt::format(
      "analysis: flow\nelements: linear\n"
      "meshes: {{tube: {{radius: {} m, length: {} m, cells_around: {}, cells_radial: {}, cells_along: {}}}}}\n"
      "fluid: {{density: 1060 kg/m^3, backflow_stabilisation: 0, viscosity: {{newtonian: {{viscosity: 4 mPa s}}}}}}\n",
      radius, length, 8 * k, 2 * k, along);
}

TEST(WallShear, Poiseuille) {
  constexpr double radius = 0.01, flow = 2e-5;
  // The mesh is a polygon of the area of the circle.
  constexpr double exact = 4 * mu * flow / (pi * radius * radius * radius);
  std::vector<double> errors;
  for (const int k : {2, 4}) {
    const test::SharedFolder folder;
    const auto report = run_and_post(folder, tube(radius, 0.01, k, 4) +
                                                 "boundary:\n  lumen_inlet: {flow: {value: 20 ml/s}}\n"
                                                 "  lumen_outlet: {pressure: 0 Pa}\n  lumen_wall: no_slip\n"
                                                 "time: {step: 10 s, steps: 12, rho_infinity: 0}\n"
                                                 "output: {every: 1}\n"
                                                 "post: {from: 80 s, spacing: 2.5 mm}\n");
    const double found = report["wall_shear"]["tawss_Pa"]["p50"], osi = report["wall_shear"]["osi"]["p99"];
    errors.push_back(found / exact - 1);
    say("  %2d cells around: wall shear stress %.4f Pa, exact %.4f Pa (%+.2f %%), OSI %.1e\n", 8 * k, found, exact,
        100 * errors.back(), osi);
    EXPECT_LT(osi, 1e-6);
    // The mean flow passes every section, and the pressure falls along the tube.
    const auto& stations = report["stations"];
    ASSERT_EQ(stations.size(), 3u);
    for (const auto& s : stations)
      EXPECT_NEAR(s["true_lumen"]["flow_downstream_mean_ml_s"].get<double>(), 20, 0.02 * 20);
  }
  EXPECT_LT(std::abs(errors[1]), 0.06);
  EXPECT_LT(std::abs(errors[1]), 0.8 * std::abs(errors[0]));
}

/// J_n by its power series.
Complex bessel(int n, Complex z) {
  Complex term = n == 0 ? Complex(1) : z / 2.0, sum = term;
  for (int k = 1; k < 60; ++k) {
    term *= -z * z / (4.0 * k * (k + n));
    sum += term;
  }
  return sum;
}

// Womersley 1955: -dp/dz = G sin(omega t), and the stress at the wall is Im{G R / Lambda J1(Lambda) / J0(Lambda) e^(i
// omega t)} with Lambda = i^(3/2) alpha. Over a period it averages 2 / pi of its amplitude, and its direction half of
// the time. At the ends, where a pressure acts alone, the flow is not quite that of the infinite tube: the median is
// that of the long part between.
TEST(WallShear, Womersley) {
  constexpr double radius = 0.002, length = 0.02, period = 1, gradient = 40, omega = 2 * pi / period;
  const Complex lambda = radius * std::sqrt(density * omega / mu) * std::exp(Complex(0, 0.75 * pi));
  const double amplitude = gradient * radius * std::abs(bessel(1, lambda) / (lambda * bessel(0, lambda)));
  std::vector<double> errors;
  for (const int k : {2, 4}) {
    const test::SharedFolder folder;
    std::string table = "t,p\n";
    for (int i = 0; i <= 100; ++i)
      table += fmt::format("{},{}\n", period * i / 100, gradient * length * std::sin(2 * pi * (i % 100) / 100));
    folder.write("pressure.csv", table);
    const auto report = run_and_post(
        folder, tube(radius, length, k, 12) +
                    "boundary:\n"
                    "  lumen_inlet: {pressure: {table: {file: pressure.csv, time_unit: s, unit: Pa}}}\n"
                    "  lumen_outlet: {pressure: 0 Pa}\n  lumen_wall: no_slip\n"
                    "time: {step: 25 ms, steps: 80}\noutput: {every: 1}\npost: {period: 1 s, spacing: 4 mm}\n");
    const double found = report["wall_shear"]["tawss_Pa"]["p50"], osi = report["wall_shear"]["osi"]["p50"];
    errors.push_back(found / (2 / pi * amplitude) - 1);
    say("  %2d cells around: TAWSS %.4f Pa, exact %.4f Pa (%+.2f %%), OSI %.4f\n", 8 * k, found, 2 / pi * amplitude,
        100 * errors.back(), osi);
    EXPECT_GT(osi, 0.499);
    EXPECT_LE(osi, 0.5);
  }
  EXPECT_LT(std::abs(errors[1]), 0.065);
  EXPECT_LT(std::abs(errors[1]), 0.8 * std::abs(errors[0]));
}

}  // namespace
}  // namespace tunica::verification
