// A harmonic wave in an elastic tube that cannot move along its axis.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tunica/mesh/generate.hpp"
#include "tunica/stages/validate/benchmark.hpp"

namespace tunica::stages::validate {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

struct ElasticTube {
  double radius = 10e-3, thickness = 1e-3, length = 200e-3;  // m
  double young = 400e3, poisson = 0.49, density = 1060;      // Pa, kg/m^3: of the wall and the blood
  double viscosity = 4e-3, pressure = 20, frequency = 5;     // Pa s, Pa, Hz

  double omega() const { return 2 * pi * frequency; }
  double area() const { return pi * radius * radius; }
  /// Radial displacement of the inner face under unit pressure: Lame, plane strain; the wall's inertia adds little.
  double give() const {
    const double inner = radius * radius, outer = std::pow(radius + thickness, 2);
    const double stiffness = young * (outer - inner) / (radius * (1 + poisson) * ((1 - 2 * poisson) * inner + outer));
    return 1 / (stiffness - omega() * omega() * density * (outer - inner) / (2 * radius));
  }
  double compliance() const { return 2 * pi * radius * give(); }  ///< dA/dp
  double matched_resistance() const { return std::sqrt(density / (area() * compliance())); }

  /// 1 - F: what viscosity leaves of the flow (Womersley 1955).
  Complex mobility() const {
    const auto argument = radius * std::sqrt(omega() * density / viscosity) * std::pow(Complex(0, 1), 1.5);
    return 1.0 - 2.0 * bessel(1, argument) / (argument * bessel(0, argument));
  }
  Complex wave_number() const { return omega() * std::sqrt(density * compliance() / (area() * mobility())); }
  Complex impedance() const { return std::sqrt(density / (area() * compliance() * mobility())); }

  /// Pressure and flow of the waves both ways that meet the pressure at the inlet and the resistance at the outlet.
  Complex pressure_at(double z) const { return forward() * (wave(z) + reflected() / wave(z)); }
  Complex flow_at(double z) const { return forward() * (wave(z) - reflected() / wave(z)) / impedance(); }

 private:
  Complex wave(double z) const { return std::exp(Complex(0, -1) * wave_number() * z); }
  Complex reflected() const {
    return (matched_resistance() - impedance()) / (matched_resistance() + impedance()) * wave(2 * length);
  }
  Complex forward() const { return pressure / (1.0 + reflected()); }
};

constexpr double first = 0.25, second = 0.75;  // of the length: where the wall is watched

/// Speed of a wave from its phases at two places.
double speed(const ElasticTube& t, Complex at_first, Complex at_second) {
  return t.omega() * (second - first) * t.length / std::arg(at_first / at_second);
}

Posed wave_case(const Variant& v) {
  const ElasticTube t;
  const int around = v.full ? 32 : 16, steps = v.full ? 80 : 40, periods = v.full ? 3 : 2;
  std::string table = "time,pressure\n";
  for (int k = 0; k <= 200; ++k)
    table += fmt::format("{},{:.12g}\n", k / (200 * t.frequency), t.pressure * std::cos(2 * pi * k / 200));
  return {.case_text =
              "title: Harmonic wave in an elastic tube\nanalysis: fsi\n" + elements_line(v) +
              fmt::format("meshes:\n"
                          "  tube: {{radius: {} m, length: {} m, wall_thickness: {} m, cells_around: {}, "
                          "cells_radial: {}, cells_along: {}, cells_through_wall: 1}}\n"
                          "  interface: {{lumen: lumen_wall, wall: wall_inner}}\n",
                          t.radius, t.length, t.thickness, around, v.full ? 4 : 2, v.full ? 32 : 12) +
              fluid_section(t.density, t.viscosity) +
              fmt::format("wall:\n"
                          "  density: {} kg/m^3\n"
                          "  material: {{neo_hooke: {{young_modulus: {} Pa, poisson_ratio: {}}}}}\n"
                          "boundary:\n"
                          "  lumen_inlet:\n"
                          "    pressure:\n"
                          "      table: {{file: pressure.csv, time_unit: s, unit: Pa}}\n"
                          "  lumen_outlet: {{resistance: {} Pa s/m^3}}\n"
                          "  wall_inlet: {{fixed: {{directions: [z]}}}}\n"
                          "  wall_outlet: {{fixed: {{directions: [z]}}}}\n"
                          "  wall_outer: {{fixed: {{directions: [z]}}}}\n"
                          "time: {{step: {} s, steps: {}}}\n",
                          t.density, t.young, t.poisson, t.matched_resistance(), 1 / (t.frequency * steps),
                          periods * steps) +
              output_section +
              fmt::format("  points:\n"
                          "    first: {{place: [{0} m, 0 m, {1} m], region: wall}}\n"
                          "    second: {{place: [{0} m, 0 m, {2} m], region: wall}}\n"
                          "    middle: [0 m, 0 m, {3} m]\n",
                          t.radius * mesh::polygon_radius(around), first * t.length, second * t.length, 0.5 * t.length),
          .mesh = {},
          .files = {{"pressure.csv", table}}};
}

std::vector<double> wave_figures(const Results& r) {
  const ElasticTube t;
  const auto amplitude = [&](const char* file, const char* column) {
    return harmonic(r.history(file, "time [s]"), r.history(file, column), 1 / t.frequency);
  };
  const auto at_first = amplitude("points", "first displacement x [m]"),
             at_second = amplitude("points", "second displacement x [m]");
  return {speed(t, at_first, at_second), std::abs(at_first), std::abs(at_second),
          std::abs(amplitude("points", "middle pressure [Pa]")),
          std::abs(amplitude("faces", "lumen_outlet flow [m^3/s]"))};
}

Plot wave_plot(const Results& r) {
  Plot plot;
  plot.options = {.title = "Radial displacement of the inner face", .x_label = "time [s]", .y_label = "mm"};
  for (const char* name : {"first", "second"}) {
    auto u = r.history("points", fmt::format("{} displacement x [m]", name));
    for (double& value : u) value *= 1e3;
    plot.series.push_back({.name = name, .x = r.history("points", "time [s]"), .y = std::move(u)});
  }
  return plot;
}

}  // namespace

std::vector<Benchmark> wave_benchmarks() {
  const ElasticTube t;
  const auto at_first = t.give() * t.pressure_at(first * t.length),
             at_second = t.give() * t.pressure_at(second * t.length);
  return {
      {.name = "elastic_tube_wave",
       .title = "Harmonic wave of 5 Hz in an elastic tube held along its axis, matched resistance",
       .source = "Closed form: Womersley's viscous flow, Lame's thick tube in plane strain, waves both ways",
       .references = {{"wave speed, 50 to 150 mm", "m/s", speed(t, at_first, at_second), 0, 0.05, 0.01},
                      {"radial displacement at 50 mm, amplitude", "m", std::abs(at_first), 0, 0.05, 0.01},
                      {"radial displacement at 150 mm, amplitude", "m", std::abs(at_second), 0, 0.05, 0.01},
                      {"pressure at 100 mm, amplitude", "Pa", std::abs(t.pressure_at(0.5 * t.length)), 0, 0.05, 0.01},
                      {"flow at the outlet, amplitude", "m^3/s", std::abs(t.flow_at(t.length)), 0, 0.05, 0.01}},
       .pose = wave_case,
       .measure = wave_figures,
       .plot = wave_plot}};
}

}  // namespace tunica::stages::validate
