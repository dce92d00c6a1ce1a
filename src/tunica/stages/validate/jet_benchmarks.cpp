// Jets behind an orifice and in a nozzle: vessels of revolution that `tunica mesh` meshes.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tunica/stages/validate/benchmark.hpp"
#include "tunica/stages/validate/revolved.hpp"

namespace tunica::stages::validate {

namespace {

using std::numbers::pi;

struct Jet {
  std::string title;
  double density, viscosity;  ///< kg/m^3, Pa s
  double flow;                ///< m^3/s, as a parabola at the inlet
  double step;                ///< s
  int steps;
};

Posed jet_case(const Jet& jet, const Variant& v, const RevolvedVessel& vessel, const std::string& points) {
  return {.case_text = fmt::format("title: {}\nanalysis: flow\n", jet.title) + elements_line(v) +
                       "meshes: {length_unit: mm, lumen: {simvascular: mesh/lumen}}\n" +
                       fluid_section(jet.density, jet.viscosity) +
                       fmt::format("boundary:\n"
                                   "  lumen_inlet: {{flow: {} m^3/s}}\n"
                                   "  lumen_outlet: {{pressure: 0 Pa}}\n"
                                   "  lumen_wall: no_slip\n"
                                   "time: {{step: {} s, steps: {}, rho_infinity: 0}}\n",
                                   jet.flow, jet.step, jet.steps) +
                       output_section + "  points:\n" + points,
          .mesh = {},
          .files = mesh_files(vessel)};
}

std::string axis_point(const char* name, double z) { return fmt::format("    {}: [0 m, 0 m, {} m]\n", name, z); }

// Points that share a circle evenly: in the middle of rings of the same area.
constexpr int rings = 4, rays = 8;

std::string section_points(const char* name, double z, double radius) {
  std::string text;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < rays; ++k) {
      const double r = radius * std::sqrt((i + 0.5) / rings), angle = 2 * pi * (k + 0.5 * (i % 2)) / rays;
      text += fmt::format("    {}{}: [{:.9g} m, {:.9g} m, {} m]\n", name, i * rays + k, r * std::cos(angle),
                          r * std::sin(angle), z);
    }
  return text;
}

double section_pressure(const Results& r, const char* name) {
  double sum = 0;
  for (int k = 0; k < rings * rays; ++k) sum += r.last("points", fmt::format("{}{} pressure [Pa]", name, k));
  return sum / (rings * rays);
}

Plot axis_plot(const Results& r, std::string title, std::string column) {
  Plot plot;
  plot.options = {.title = std::move(title), .x_label = "time [s]", .y_label = column};
  plot.series.push_back({.name = column, .x = r.history("points", "time [s]"), .y = r.history("points", column)});
  return plot;
}

// --- orifice ------------------------------------------------------------------------------------------------------

Posed orifice_case(const Variant& v) {
  constexpr double tube = 12e-3, hole = 4.5e-3, plate = 2e-3;  // m
  return jet_case(
      {.title = "Orifice of 9 mm in a tube of 24 mm",
       .density = 1060,
       .viscosity = 4e-3,
       .flow = 12e-6,
       .step = v.full ? 0.02 : 0.05,
       .steps = v.full ? 120 : 48},
      v,
      {.profile = {{-30e-3, tube}, {0, tube}, {0, hole}, {plate, hole}, {plate, tube}, {92e-3, tube}},
       .spacing = 0.5e-3,
       .elements_across = v.full ? 6.0 : 3.0,
       .shortest_edge = 0.5e-3},
      section_points("before", -15e-3, tube) + section_points("behind", 10e-3, tube) + axis_point("jet", 20e-3));
}

Benchmark orifice() {
  return {
      .name = "orifice",
      .title = "Flow through an orifice of 9 mm in a tube of 24 mm, 12 ml/s",
      .source =
          "Computed: own axisymmetric Taylor-Hood solution, 34.4 and 35.2 Pa on two meshes, 0.2593 m/s; a wedge of 6 "
          "degrees between planes of symmetry with 37 quadratic elements across the hole: 35.1 Pa, 0.2619 m/s; what "
          "lies between does not deviate",
      .references = {{"pressure drop, -15 to 10 mm", "Pa", 34.4, 0, 0.12, 0.05, 35.2},
                     {"velocity on the axis at 20 mm", "m/s", 0.25934, 0, 0.12, 0.05, 0.2619}},
      .pose = orifice_case,
      .measure =
          [](const Results& r) {
            return std::vector{section_pressure(r, "before") - section_pressure(r, "behind"),
                               r.last("points", "jet velocity z [m/s]")};
          },
      .plot = [](const Results& r) { return axis_plot(r, "Axis, 20 mm behind the plate", "jet velocity z [m/s]"); }};
}

// --- FDA nozzle ---------------------------------------------------------------------------------------------------

Posed nozzle_case(const Variant& v) {
  constexpr double pipe = 6e-3, throat = 2e-3;  // m; the expansion is at z = 0
  return jet_case(
      {.title = "FDA nozzle, sudden expansion, Re 500",
       .density = 1056,
       .viscosity = 3.5e-3,
       .flow = 5.20624e-6,
       .step = v.full ? 0.01 : 0.02,
       .steps = v.full ? 200 : 75},
      v,
      {.profile = {{-82.685e-3, pipe}, {-62.685e-3, pipe}, {-40e-3, throat}, {0, throat}, {0, pipe}, {80e-3, pipe}},
       .spacing = 0.25e-3,
       .elements_across = v.full ? 7.0 : 4.0,
       .shortest_edge = 0.2e-3},
      axis_point("before", -64e-3) + axis_point("throat", -20e-3) + axis_point("expansion", 0) +
          axis_point("jet", 32e-3));
}

Benchmark nozzle() {
  return {
      .name = "fda_nozzle",
      .title = "FDA nozzle with sudden expansion, Re 500",
      .source =
          "Computed: own axisymmetric Taylor-Hood solution; measured: particle image velocimetry and wall pressures "
          "of one laboratory, FDA benchmark, data set 243 (Hariharan P et al. J Biomech Eng 133, 041002 (2011)); "
          "what lies between the two does not deviate",
      .references = {{"velocity on the axis, throat, -20 mm", "m/s", 0.6737, 0, 0.05, 0, 0.686341},
                     {"velocity on the axis, jet, 32 mm", "m/s", 0.6658, 0, 0.05, 0, 0.654146},
                     {"pressure drop, -64 to 0 mm", "Pa", 309.8, 0, 0.05, 0, 484.25}},
      .pose = nozzle_case,
      .measure =
          [](const Results& r) {
            return std::vector{r.last("points", "throat velocity z [m/s]"), r.last("points", "jet velocity z [m/s]"),
                               r.last("points", "before pressure [Pa]") - r.last("points", "expansion pressure [Pa]")};
          },
      .plot = [](const Results& r) { return axis_plot(r, "Axis, 32 mm behind the expansion", "jet velocity z [m/s]"); },
      .long_run = true};
}

}  // namespace

std::vector<Benchmark> jet_benchmarks() { return {orifice(), nozzle()}; }

}  // namespace tunica::stages::validate
