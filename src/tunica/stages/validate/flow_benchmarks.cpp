// Blood in rigid walls.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/slab.hpp"
#include "tunica/stages/validate/benchmark.hpp"

namespace tunica::stages::validate {

namespace {

using std::numbers::pi;
constexpr const char* slab_mesh = "meshes: {length_unit: m, lumen: {simvascular: lumen}}\n";

// --- tubes --------------------------------------------------------------------------------------------------------

struct Tube {
  double radius = 10e-3, length = 30e-3;    // m
  double density = 1060, viscosity = 4e-3;  // kg/m^3, Pa s
  double flow = 5e-6;                       // m^3/s
  /// Of the pulsatile flow [s, Pa]. So slow that its kinetic energy is far below its pressure: the closed form knows
  /// neither what blood that flows back brings in through an opening, nor what the stabilisation there takes of it.
  double period = 1, pressure_amplitude = 0.1;
};

std::string tube_mesh(const Tube& t, const Variant& v) {
  return fmt::format(
      "meshes: {{tube: {{radius: {} m, length: {} m, cells_around: {}, cells_radial: {}, cells_along: {}}}}}\n",
      t.radius, t.length, v.full ? 48 : 24, v.full ? 4 : 2, v.full ? 12 : 4);
}

Posed poiseuille_case(const Variant& v) {
  const Tube t;
  return {.case_text = "title: Poiseuille flow\nanalysis: flow\n" + elements_line(v) + tube_mesh(t, v) +
                       fluid_section(t.density, t.viscosity) +
                       fmt::format("boundary:\n"
                                   "  lumen_inlet: {{flow: {} m^3/s}}\n"
                                   "  lumen_outlet: {{pressure: 0 Pa}}\n"
                                   "  lumen_wall: no_slip\n"
                                   "time: {{step: 1000 s, steps: 3, rho_infinity: 0}}\n",
                                   t.flow) +
                       output_section +
                       fmt::format("  points: {{before: [0 m, 0 m, {} m], centre: [0 m, 0 m, {} m], "
                                   "behind: [0 m, 0 m, {} m]}}\n",
                                   0.25 * t.length, 0.5 * t.length, 0.75 * t.length)};
}

/// Amplitude of the flow under a pressure drop of Re(A e^(i omega t)): Womersley (1955).
std::complex<double> womersley_flow(const Tube& t) {
  const std::complex<double> i(0, 1);
  const double omega = 2 * pi / t.period, alpha = t.radius * std::sqrt(omega * t.density / t.viscosity);
  const auto argument = alpha * std::pow(i, 1.5);
  return pi * t.radius * t.radius * t.pressure_amplitude / (i * omega * t.density * t.length) *
         (1.0 - 2.0 * bessel(1, argument) / (argument * bessel(0, argument)));
}

constexpr int womersley_periods = 4;

Posed womersley_case(const Variant& v) {
  const Tube t;
  const int steps = v.full ? 200 : 25;  // of a period
  std::string table = "time,pressure\n";
  for (int k = 0; k <= 200; ++k)
    table += fmt::format("{},{:.12g}\n", t.period * k / 200, t.pressure_amplitude * std::cos(2 * pi * k / 200));
  return {.case_text = "title: Womersley flow\nanalysis: flow\n" + elements_line(v) + tube_mesh(t, v) +
                       fluid_section(t.density, t.viscosity) +
                       fmt::format("boundary:\n"
                                   "  lumen_inlet:\n"
                                   "    pressure:\n"
                                   "      table: {{file: pressure.csv, time_unit: s, unit: Pa}}\n"
                                   "  lumen_outlet: {{pressure: 0 Pa}}\n"
                                   "  lumen_wall: no_slip\n"
                                   "time: {{step: {} s, steps: {}}}\n",
                                   t.period / steps, womersley_periods * steps) +
                       output_section,
          .mesh = {},
          .files = {{"pressure.csv", table}}};
}

/// Amplitude and phase of the flow in the last period.
std::vector<double> womersley_figures(const Results& r) {
  const auto amplitude =
      harmonic(r.history("faces", "time [s]"), r.history("faces", "lumen_outlet flow [m^3/s]"), Tube{}.period);
  return {std::abs(amplitude), std::arg(amplitude)};
}

// --- cavity -------------------------------------------------------------------------------------------------------

constexpr double cavity_depth = 0.05;

Posed cavity_case(const Variant& v) {
  const int cells = v.full ? 32 : 12;
  const std::pair<const char*, std::array<double, 2>> places[] = {{"u1", {0.5, 0.4531}},
                                                                  {"u2", {0.5, 0.1719}},
                                                                  {"u3", {0.5, 0.9531}},
                                                                  {"v1", {0.2344, 0.5}},
                                                                  {"v2", {0.8047, 0.5}}};
  std::string points = "  points:\n";
  for (const auto& [name, x] : places)
    points += fmt::format("    {}: [{} m, {} m, {} m]\n", name, x[0], x[1], 0.5 * cavity_depth);
  return {
      .case_text = "title: Lid-driven cavity, Re 100\nanalysis: flow\n" + elements_line(v) + slab_mesh +
                   fluid_section(1, 0.01) +
                   fmt::format("boundary:\n"
                               "  x_min: no_slip\n"
                               "  x_max: no_slip\n"
                               "  y_min: no_slip\n"
                               "  y_max: {{profile: {{velocity: [\"1\", \"0\", \"0\"], unit: m/s, length_unit: m}}}}\n"
                               "  z_min: symmetry\n"
                               "  z_max: symmetry\n"
                               "pressure_point: {{place: [0 m, 0 m, 0 m]}}\n"
                               "time: {{step: 0.5 s, steps: {}, rho_infinity: 0}}\n",
                               v.full ? 80 : 40) +
                   output_section + points,
      .mesh = mesh::box(cells, cells, 1, {{1, 1, cavity_depth}}, mesh::RegionKind::lumen)};
}

std::vector<double> cavity_figures(const Results& r) {
  return {r.last("points", "u1 velocity x [m/s]"), r.last("points", "u2 velocity x [m/s]"),
          r.last("points", "u3 velocity x [m/s]"), r.last("points", "v1 velocity y [m/s]"),
          r.last("points", "v2 velocity y [m/s]")};
}

// --- backward-facing step -----------------------------------------------------------------------------------------

// Points at two distances from a wall: where the velocity along it changes its sign there is followed to the wall.
constexpr double step_gaps[] = {0.01, 0.02};
constexpr int step_points = 60;
struct StepWall {
  const char* name;
  double side, begin, end;
};
constexpr StepWall step_walls[] = {{"low", -0.5, 4, 8}, {"high", 0.5, 3, 13}};

double place_of(const StepWall& wall, int k) { return wall.begin + (wall.end - wall.begin) * k / step_points; }

// A channel of 1 cm: one of 1 m would be 30 m long, which no vessel is.
Posed step_case(const Variant& v) {
  std::string points = "  points:\n";
  for (const auto& wall : step_walls)
    for (int gap = 0; gap < 2; ++gap)
      for (int k = 0; k <= step_points; ++k)
        points += fmt::format("    {}{}_{}: [{:.6g} cm, {:.6g} cm, 0.05 cm]\n", wall.name, gap, k, place_of(wall, k),
                              wall.side > 0 ? wall.side - step_gaps[gap] : wall.side + step_gaps[gap]);
  return {.case_text =
              "title: Backward-facing step, Re 800\nanalysis: flow\n" + elements_line(v) +
              "meshes: {length_unit: cm, lumen: {simvascular: lumen}}\n" + fluid_section(100, 1.0 / 800) +
              fmt::format("boundary:\n"
                          "  inlet: {{profile: {{velocity: [\"24*y*(0.5-y)*(t<0.05 ? t/0.05 : 1)\", \"0\", \"0\"], "
                          "unit: m/s, length_unit: cm}}}}\n"
                          "  outlet: {{pressure: 0 Pa}}\n"
                          "  wall_low: no_slip\n"
                          "  wall_high: no_slip\n"
                          "  side_low: symmetry\n"
                          "  side_high: symmetry\n"
                          "time: {{step: 0.02 s, steps: {}, rho_infinity: 0}}\n",
                          v.full ? 150 : 4) +
              output_section + points,
          .mesh = mesh::backward_step({.cells_across = v.full ? 16 : 6, .cells_along = v.full ? 90 : 24})};
}

/// Places where u along a wall changes its sign, followed from two distances to the wall; NaN for one that is not
/// there.
std::vector<double> sign_changes(const Results& r, const StepWall& wall) {
  std::vector<double> at[2];
  for (int gap = 0; gap < 2; ++gap) {
    double before = 0;
    for (int k = 0; k <= step_points; ++k) {
      const double u = r.last("points", fmt::format("{}{}_{} velocity x [m/s]", wall.name, gap, k));
      if (k > 0 && (u < 0) != (before < 0))
        at[gap].push_back(place_of(wall, k - 1) + (place_of(wall, k) - place_of(wall, k - 1)) * before / (before - u));
      before = u;
    }
  }
  std::vector<double> on_wall;
  for (std::size_t k = 0; k < std::min(at[0].size(), at[1].size()); ++k) on_wall.push_back(2 * at[0][k] - at[1][k]);
  return on_wall;
}

std::vector<double> step_figures(const Results& r) {
  const auto low = sign_changes(r, step_walls[0]), high = sign_changes(r, step_walls[1]);
  return {low.empty() ? NAN : low.back(), high.size() < 2 ? NAN : high[0], high.size() < 2 ? NAN : high[1]};
}

}  // namespace

std::vector<Benchmark> flow_benchmarks() {
  const Tube t;
  const double mean_velocity = t.flow / (pi * t.radius * t.radius),
               gradient = 8 * t.viscosity * t.flow / (pi * std::pow(t.radius, 4));
  const auto pulse = womersley_flow(t);
  return {
      {.name = "poiseuille",
       .title = "Poiseuille flow in a round tube",
       .source = "Closed form: Hagen-Poiseuille",
       .references = {{"pressure gradient, middle half", "Pa/m", gradient, 0, 0.04, 0.01},
                      {"velocity on the axis", "m/s", 2 * mean_velocity, 0, 0.03, 0.01}},
       .pose = poiseuille_case,
       .measure =
           [](const Results& r) {
             const double drop = r.last("points", "before pressure [Pa]") - r.last("points", "behind pressure [Pa]");
             return std::vector{drop / (0.5 * Tube{}.length), r.last("points", "centre velocity z [m/s]")};
           }},
      {.name = "womersley",
       .title = "Womersley flow in a round tube, alpha 12.9",
       .source = "Closed form: Womersley JR. J Physiol 127, 553-563 (1955)",
       .references = {{"amplitude of the flow", "m^3/s", std::abs(pulse), 0, 0.05, 0.01},
                      {"phase of the flow", "rad", std::arg(pulse), 1, 0.03, 0.01}},
       .pose = womersley_case,
       .measure = womersley_figures},
      {.name = "cavity",
       .title = "Lid-driven cavity, Re 100",
       .source = "Computed: Ghia U, Ghia KN, Shin CT. J Comput Phys 48, 387-411 (1982), tables I and II",
       .references = {{"u at (0.5, 0.4531)", "m/s", -0.21090, 0, 0.05, 0.02},
                      {"u at (0.5, 0.1719)", "m/s", -0.10150, 0, 0.05, 0.02},
                      {"u at (0.5, 0.9531)", "m/s", 0.68717, 0, 0.05, 0.02},
                      {"v at (0.2344, 0.5)", "m/s", 0.17527, 0, 0.05, 0.02},
                      {"v at (0.8047, 0.5)", "m/s", -0.24533, 0, 0.05, 0.02}},
       .pose = cavity_case,
       .measure = cavity_figures},
      {.name = "step",
       .title = "Flow over a backward-facing step, Re 800",
       .source = "Computed, two-dimensional: Gartling DK. Int J Numer Methods Fluids 11, 953-967 (1990)",
       .references = {{"reattachment at the lower wall", "cm", 6.10, 0, not_judged, 0.03},
                      {"separation at the upper wall", "cm", 4.85, 0, not_judged, 0.03},
                      {"reattachment at the upper wall", "cm", 10.48, 0, not_judged, 0.03}},
       .pose = step_case,
       .measure = step_figures,
       .long_run = true},
  };
}

}  // namespace tunica::stages::validate
