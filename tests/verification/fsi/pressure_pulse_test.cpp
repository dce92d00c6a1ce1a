// Pressure pulse in a compliant tube (Formaggia, Gerbeau, Nobile & Quarteroni 2001): arrival of the front, balances of
// mass and of power at the interface, independence of the number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <vector>

#include "tunica/coupling/monitors.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::verification {
namespace {

using coupling::Problem;
using coupling::ProblemInput;
using coupling::State;

constexpr double length = 0.05, radius = 0.005, thickness = 0.001;  // m
constexpr double young = 3e5, pulse = 1333.2, pulse_end = 3e-3;     // Pa, Pa, s
constexpr double dt = 1e-4;                                         // s

std::size_t at(std::int32_t node) { return 4 * static_cast<std::size_t>(node); }

[[gnu::format(printf, 1, 2)]] void print(const char* format, ...) {
  if (parallel::rank(MPI_COMM_WORLD) != 0) return;
  std::va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::fflush(stdout);
}

ProblemInput pulse_input(wall::Element element) {
  ProblemInput in;
  in.fluid = fluid::Parameters{};
  in.fluid->density = 1000;
  in.fluid->viscosity = fluid::Newtonian{0.003};
  in.fluid->stabilisation = fluid::Stabilisation::vms_classic;  // the arrival asked for is that of related codes
  in.wall = wall::Parameters{};
  in.wall->element = element;
  in.wall->density = 1200;
  auto& elastic = std::get<0>(in.wall->material).elastic;
  elastic.young_modulus = young;
  elastic.poisson_ratio = 0.3;
  in.boundary.fluid = in.fluid;
  in.boundary.wall_has_pressure = element == wall::Element::mixed;
  in.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  const bc::Step step{.value = pulse, .start = 0.0, .end = pulse_end};
  in.boundary.conditions = {{"lumen_inlet", bc::Pressure{bc::WaveformInput{.source = step}}},
                            {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}},
                            {"wall_inlet", bc::Fixed{}},
                            {"wall_outlet", bc::Fixed{}},
                            {"wall_outer", bc::Free{}}};
  in.newton.relative_tolerance = 1e-6;
  in.linear.tolerance = 1e-4;
  return in;
}

distributed::DistributedMesh tube(MPI_Comm comm, int around, int radial, int along) {
  mesh::MeshData data;
  if (parallel::rank(comm) == 0)
    data = mesh::tube({.radius = radius,
                       .length = length,
                       .wall_thickness = thickness,
                       .cells_around = around,
                       .cells_radial = radial,
                       .cells_along = along,
                       .cells_through_wall = 2});
  return distributed::distribute(data, comm);
}

/// Mean radial displacement of the inner wall [m] and mean pressure of the section [Pa] at z.
struct Section {
  double displacement, pressure;
};
Section section(const distributed::DistributedMesh& mesh, const State& state, double z) {
  double sums[4] = {};
  const auto here = [&](std::int32_t i) {
    return i < mesh.owned_nodes && std::abs(mesh.points[i][2] - z) < 1e-6 * length;
  };
  std::vector<char> seen(mesh.nodes(), 0);
  for (const auto& region : mesh.regions)
    if (region.kind == mesh::RegionKind::lumen)
      for (const auto& element : region.elements)
        for (const auto i : element) {
          if (!here(i) || seen[i]) continue;
          seen[i] = 1;
          sums[0] += state.velocity_pressure[at(i) + 3];
          sums[1] += 1;
          const double r = std::hypot(mesh.points[i][0], mesh.points[i][1]);
          if (r < 0.999 * radius) continue;
          const double* u = state.displacement.data() + at(i);
          sums[2] += (u[0] * mesh.points[i][0] + u[1] * mesh.points[i][1]) / r;
          sums[3] += 1;
        }
  parallel::global_sum(mesh.comm, sums);
  return {sums[2] / sums[3], sums[0] / sums[1]};
}

/// A signal sampled at the ends of the steps.
struct Signal {
  std::vector<double> values;
  double most() const { return *std::max_element(values.begin(), values.end()); }
  /// First time at which it reaches `share` of its largest value, interpolated linearly [s].
  double arrival(double share) const {
    const double target = share * most();
    double last = 0;
    for (std::size_t k = 0; k < values.size(); last = values[k], ++k)
      if (values[k] >= target) return dt * (static_cast<double>(k) + (target - last) / (values[k] - last));
    return std::numeric_limits<double>::quiet_NaN();
  }
};

/// Foot by intersecting tangents, the usual arrival of a pulse wave (Gaddum et al. 2013): the tangent at the steepest
/// rise goes back to the baseline, which is zero.
double foot(const Signal& s) {
  double slope = 0, when = 0, last = 0;
  for (std::size_t k = 0; k < s.values.size(); last = s.values[k], ++k)
    if ((s.values[k] - last) / dt > slope) {
      slope = (s.values[k] - last) / dt;
      when = dt * (static_cast<double>(k) + 0.5) - 0.5 * (s.values[k] + last) / slope;
    }
  return when;
}

void print_arrivals(const char* what, const Signal& s) {
  print("  %-20s foot %.2f; 5 %% %.2f, 10 %% %.2f, 20 %% %.2f, 25 %% %.2f, half %.2f, 90 %% %.2f ms\n", what,
        1e3 * foot(s), 1e3 * s.arrival(0.05), 1e3 * s.arrival(0.1), 1e3 * s.arrival(0.2), 1e3 * s.arrival(0.25),
        1e3 * s.arrival(0.5), 1e3 * s.arrival(0.9));
}

/// Inner radial displacement of the wall alone under the static pulse, ends held along the axis or free [m].
double static_displacement(bool plane_strain) {
  const auto mesh = distributed::distribute(mesh::thick_cylinder({.inner = radius,
                                                                  .outer = radius + thickness,
                                                                  .length = thickness,
                                                                  .cells_radial = 2,
                                                                  .cells_around = 16,
                                                                  .cells_along = 2},
                                                                 mesh::Sector::quarter),
                                            MPI_COMM_SELF);
  ProblemInput in = pulse_input(wall::Element::mixed);
  in.fluid.reset();
  in.boundary.fluid.reset();
  in.boundary.interfaces.clear();
  const auto held = [](int direction) {
    bc::Fixed fixed;
    fixed.directions = {direction == 0, direction == 1, direction == 2, false, false};
    return fixed;
  };
  in.boundary.conditions = {{"wall_inner", bc::Pressure{bc::WaveformInput{pulse}}},
                            {"wall_outer", bc::Free{}},
                            {"wall_inlet", held(2)},
                            {"wall_outlet", plane_strain ? bc::Condition(held(2)) : bc::Condition(bc::Free{})},
                            {"symmetry_x", held(0)},
                            {"symmetry_y", held(1)}};
  Problem problem(mesh, in);
  State state = problem.initial_state();
  const auto report = problem.solve_static(state, 1.0);
  EXPECT_TRUE(report.converged) << report.failure;
  double most = 0;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i)
    most = std::max(most, std::hypot(state.displacement[at(i)], state.displacement[at(i) + 1]));
  return most;
}

struct Course {
  Signal displacement[3], pressure[3];  ///< at z = 1.5, 2.5, 3.5 cm
  double worst_mass = 0, worst_power = 0;
};

Course run_pulse() {
  const auto mesh = tube(MPI_COMM_WORLD, 20, 3, 40);
  Problem problem(mesh, pulse_input(wall::Element::mixed));
  const coupling::Monitors monitors(problem);
  State state = problem.initial_state();
  Course course;
  double peak_power = 0, peak_flow = 0;
  for (int k = 0; k < 85; ++k) {
    const auto report = problem.advance(state, dt);
    EXPECT_TRUE(report.converged) << "step " << k << ": " << report.failure;
    if (!report.converged) return course;
    const auto record = monitors.evaluate(dt);
    peak_power = std::max(peak_power, std::abs(record.interface_power_wall));
    peak_flow = std::max(peak_flow, record.largest_flow);
    const double mass = std::abs(record.mass_residual) / peak_flow;
    const double power = std::abs(record.interface_power_lumen + record.interface_power_wall) / peak_power;
    course.worst_mass = std::max(course.worst_mass, mass);
    course.worst_power = std::max(course.worst_power, power);
    for (int s = 0; s < 3; ++s) {
      const Section values = section(mesh, state, (0.3 + 0.2 * s) * length);
      course.displacement[s].values.push_back(values.displacement);
      course.pressure[s].values.push_back(values.pressure);
    }
    print(
        "  t %.1f ms: %zu Newton, %d linear, u %.5f cm, p %.0f dyn/cm2 at z = 2.5 cm, mass balance %.1e, interface "
        "power %+.3e W, residual %.1e\n",
        1e3 * state.time, report.iterations.size(), report.linear_iterations(),
        1e2 * course.displacement[1].values.back(), 10 * course.pressure[1].values.back(), mass,
        record.interface_power_wall, power);
  }
  return course;
}

TEST(PressurePulse, FrontDisplacementAndBalances) {
  print("pressure pulse, 30000 elements\n");
  const Course course = run_pulse();
  const Signal &u = course.displacement[1], &p = course.pressure[1];
  print("arrival at z = 2.5 cm: foot by intersecting tangents, and shares of the largest value\n");
  print_arrivals("radial displacement", u);
  print_arrivals("pressure", p);
  const auto speed = [](const Signal(&s)[3]) { return 0.4 * length / (foot(s[2]) - foot(s[0])); };
  const double by_displacement = speed(course.displacement), by_pressure = speed(course.pressure);
  print(
      "wave speed, foot to foot from z = 1.5 to 3.5 cm: %.0f cm/s by displacement, %.0f by pressure (Moens-Korteweg "
      "548, "
      "thin plane strain 574, thick wall 525)\n",
      1e2 * by_displacement, 1e2 * by_pressure);
  const double plane = static_displacement(true), free = static_displacement(false);
  print(
      "largest radial displacement at z = 2.5 cm %.5f cm at a pressure of %.0f; static at 13332: linear plane strain "
      "0.0121, this law %.5f in plane strain, %.5f with free ends\n",
      1e2 * u.most(), 10 * p.most(), 1e2 * plane, 1e2 * free);
  print("worst mass balance %.1e of the flow, worst interface power residual %.1e of the power\n", course.worst_mass,
        course.worst_power);
  for (const Signal* s : {&u, &p}) {
    EXPECT_GT(foot(*s), 4.4e-3);
    EXPECT_LT(foot(*s), 4.8e-3);
  }
  for (const double c : {by_displacement, by_pressure}) {
    EXPECT_GT(c, 4.5);
    EXPECT_LT(c, 6.0);
  }
  EXPECT_LT(u.most(), free);
  EXPECT_LT(course.worst_mass, 1e-6);
  EXPECT_LT(course.worst_power, 1e-6);
}

/// Largest displacement, pressure at the middle and flow after a few steps, on the ranks of `comm`.
std::vector<double> short_run(MPI_Comm comm, wall::Element element) {
  const auto mesh = tube(comm, 12, 2, 16);
  ProblemInput in = pulse_input(element);
  in.newton.relative_tolerance = 1e-9;
  Problem problem(mesh, in);
  const coupling::Monitors monitors(problem);
  State state = problem.initial_state();
  for (int k = 0; k < 6; ++k) {
    const auto report = problem.advance(state, dt);
    EXPECT_TRUE(report.converged) << report.failure;
  }
  const auto record = monitors.evaluate(dt);
  const Section middle = section(mesh, state, 0.125 * length);
  return {record.max_displacement, middle.displacement, middle.pressure, record.faces[0].flow, record.wall_strain};
}

TEST(PressurePulse, SameOnAnyNumberOfRanks) {
  for (const auto element : {wall::Element::mixed, wall::Element::displacement}) {
    const auto alone = short_run(MPI_COMM_SELF, element), together = short_run(MPI_COMM_WORLD, element);
    double worst = 0;
    for (std::size_t k = 0; k < alone.size(); ++k) worst = std::max(worst, std::abs(together[k] / alone[k] - 1));
    print("six steps, one rank against all, %s element: displacement, pressure, flow, energy differ by %.1e at most\n",
          element == wall::Element::mixed ? "mixed" : "displacement", worst);
    EXPECT_LT(worst, 1e-6);
  }
}

}  // namespace
}  // namespace tunica::verification
