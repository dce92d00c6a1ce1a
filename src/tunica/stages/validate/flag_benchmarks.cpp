// Turek & Hron (2006): an elastic flag behind a cylinder in a channel, in a slab of one layer of cells between planes
// of symmetry. Forces are those of a slab of 1 m.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tunica/mesh/slab.hpp"
#include "tunica/stages/validate/benchmark.hpp"

namespace tunica::stages::validate {

namespace {

constexpr double depth = 0.02;  // m

struct FlagCase {
  int number;
  double wall_density, shear_modulus;  ///< kg/m^3, Pa
  double mean_velocity;                ///< m/s
  double step, end;                    ///< s
  double quick_end;                    ///< s
  double rho_infinity;
  std::string mesh_motion{};  ///< other than by default
};

constexpr double start_up = 2.0;  // s, half a cosine

std::string case_text(const FlagCase& c, const Variant& v) {
  const double end = v.full ? c.end : c.quick_end;
  return fmt::format(
             "title: Turek & Hron (2006), FSI{}\n"
             "analysis: fsi\n"
             "{}"
             "meshes:\n"
             "  length_unit: m\n"
             "  lumen: {{simvascular: lumen}}\n"
             "  wall: {{simvascular: wall, region_array: region, regions: {{flag: 1}}}}\n"
             "  interface: {{lumen: flag_lumen, wall: flag_wall}}\n"
             "fluid: {{density: 1000 kg/m^3, viscosity: {{newtonian: {{viscosity: 1 Pa s}}}}}}\n"
             "wall:\n"
             "  density: {} kg/m^3\n"
             "  material: {{st_venant_kirchhoff: {{shear_modulus: {} Pa, poisson_ratio: 0.4}}}}\n",
             c.number, elements_line(v), c.wall_density, c.shear_modulus) +
         fmt::format(
             "boundary:\n"
             "  inlet:\n"
             "    profile:\n"
             "      velocity: [\"1.5*{0}*y*(0.41-y)/0.205^2*(t < {1} ? (1-cos(pi*t/{1}))/2 : 1)\", \"0\", \"0\"]\n"
             "      unit: m/s\n"
             "      length_unit: m\n"
             "  outlet: {{pressure: 0 Pa}}\n"
             "  channel: no_slip\n"
             "  cylinder: no_slip\n"
             "  side_low: symmetry\n"
             "  side_high: symmetry\n"
             "  flag_root: fixed\n"
             "  flag_low: symmetry\n"
             "  flag_high: symmetry\n"
             "time: {{step: {2} s, steps: {3}, rho_infinity: {4}}}\n"
             "output:\n"
             "  every: 100000\n"
             "  units: {{length: m, time: s, velocity: m/s, pressure: Pa, stress: Pa, flow: m^3/s}}\n"
             "  points: {{A: {{place: [0.6 m, 0.2 m, {5} m], region: wall}}}}\n"
             "  forces: true\n"
             "{6}",
             c.mean_velocity, start_up, c.step, std::llround(end / c.step), c.rho_infinity, 0.5 * depth,
             c.mesh_motion.empty() ? "" : fmt::format("mesh_motion: {{{}}}\n", c.mesh_motion));
}

Posed pose(const FlagCase& c, const Variant& v) {
  return {.case_text = case_text(c, v),
          .mesh = mesh::flag_behind_cylinder({.depth = depth, .refinement = v.full ? 2 : 1}),
          .files = {}};
}

std::vector<double> force(const Results& r, const char* axis) {
  auto sum = r.history("forces", fmt::format("cylinder force {} [N]", axis));
  const auto flag = r.history("forces", fmt::format("flag_lumen force {} [N]", axis));
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = (sum[k] + flag[k]) / depth;
  return sum;
}

std::vector<double> displacement(const Results& r, const char* axis) {
  return r.history("points", fmt::format("A displacement {} [m]", axis));
}

std::vector<double> steady_figures(const Results& r) {
  return {displacement(r, "x").back(), displacement(r, "y").back(), force(r, "x").back(), force(r, "y").back()};
}

/// Mean, amplitude and frequency as the paper has them: from the extremes of the last second; the frequency from the
/// rises through the mean.
struct Oscillation {
  double mean = 0, amplitude = 0, frequency = 0;
};

Oscillation oscillation(const std::vector<double>& time, const std::vector<double>& value) {
  constexpr double window = 1.0;  // s
  const auto begin =
      static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), time.back() - window) - time.begin());
  const auto [low, high] = std::minmax_element(value.begin() + static_cast<std::ptrdiff_t>(begin), value.end());
  Oscillation o{0.5 * (*low + *high), 0.5 * (*high - *low), 0};
  std::vector<double> rises;
  for (std::size_t k = begin + 1; k < value.size(); ++k) {
    const double a = value[k - 1] - o.mean, b = value[k] - o.mean;
    if (a < 0 && b >= 0) rises.push_back(time[k - 1] + (time[k] - time[k - 1]) * a / (a - b));
  }
  if (rises.size() > 1) o.frequency = static_cast<double>(rises.size() - 1) / (rises.back() - rises.front());
  return o;
}

std::vector<double> periodic_figures(const Results& r) {
  const auto time = r.history("points", "time [s]"), force_time = r.history("forces", "time [s]");
  const auto x = oscillation(time, displacement(r, "x")), y = oscillation(time, displacement(r, "y")),
             drag = oscillation(force_time, force(r, "x"));
  return {x.mean, x.amplitude, y.mean, y.amplitude, y.frequency, drag.mean, drag.amplitude};
}

Plot tip_plot(const Results& r) {
  Plot plot;
  plot.options = {.title = "Tip of the flag", .x_label = "time [s]", .y_label = "displacement [mm]"};
  const auto time = r.history("points", "time [s]");
  for (const char* axis : {"x", "y"}) {
    auto u = displacement(r, axis);
    for (double& value : u) value *= 1e3;
    plot.series.push_back({.name = fmt::format("u_{}", axis), .x = time, .y = std::move(u)});
  }
  return plot;
}

constexpr const char* paper =
    "Computed: Turek S, Hron J. Proposal for numerical benchmarking of fluid-structure interaction between an elastic "
    "object and laminar incompressible flow. LNCSE 53, 371-385 (2006)";
constexpr const char* later_figures =
    "; these figures are the later ones of the same group (Turek S et al. LNCSE 73, 413-424 (2010)), where the first "
    "ones had u_y 1.48 +- 34.38 mm";

Benchmark flag_benchmark(const FlagCase& c, std::vector<Reference> references, bool periodic) {
  return {.name = fmt::format("turek_hron_fsi{}", c.number),
          .title = fmt::format("Flag behind a cylinder, FSI{}", c.number),
          .source = fmt::format("{}{}", paper, c.number == 3 ? later_figures : ""),
          .references = std::move(references),
          .pose = [c](const Variant& v) { return pose(c, v); },
          .measure = periodic ? periodic_figures : steady_figures,
          .plot = tip_plot,
          .long_run = periodic};
}

}  // namespace

std::vector<Benchmark> flag_benchmarks() {
  return {
      flag_benchmark({1, 1e3, 0.5e6, 0.2, 0.05, 10, 7.5, 0.0},
                     {{"u_x of the tip", "m", 2.27e-5, 0, 0.05, 0.01},
                      {"u_y of the tip", "m", 8.209e-4, 0, 0.05, 0.01},
                      {"drag", "N/m", 14.295, 0, 0.02, 0.01},
                      {"lift", "N/m", 0.7638, 0, 0.05, 0.01}},
                     false),
      // The flag swings by 80 mm: with an exponent of 1 elements at its tip are spoilt at 77 mm.
      flag_benchmark({2, 1e4, 0.5e6, 1.0, 0.005, 15, 0.1, 0.5, "stiffening_exponent: 2, minimum_quality: 0.02"},
                     {{"u_x of the tip, mean", "m", -14.58e-3, 12.44e-3, not_judged, 0.03},
                      {"u_x of the tip, amplitude", "m", 12.44e-3, 0, not_judged, 0.03},
                      {"u_y of the tip, mean", "m", 1.23e-3, 80.6e-3, not_judged, 0.03},
                      {"u_y of the tip, amplitude", "m", 80.6e-3, 0, not_judged, 0.03},
                      {"frequency of u_y", "Hz", 2.0, 0, not_judged, 0.03},
                      {"drag, mean", "N/m", 208.83, 0, not_judged, 0.03},
                      {"drag, amplitude", "N/m", 73.75, 0, not_judged, 0.03}},
                     true),
      flag_benchmark({3, 1e3, 2e6, 2.0, 0.002, 6, 0.1, 0.5},
                     {{"u_x of the tip, mean", "m", -2.88e-3, 2.72e-3, not_judged, 0.03},
                      {"u_x of the tip, amplitude", "m", 2.72e-3, 0, not_judged, 0.03},
                      {"u_y of the tip, mean", "m", 1.47e-3, 34.99e-3, not_judged, 0.03},
                      {"u_y of the tip, amplitude", "m", 34.99e-3, 0, not_judged, 0.03},
                      {"frequency of u_y", "Hz", 5.46, 0, not_judged, 0.03},
                      {"drag, mean", "N/m", 460.5, 0, not_judged, 0.03},
                      {"drag, amplitude", "N/m", 27.7, 0, not_judged, 0.03}},
                     true),
  };
}

}  // namespace tunica::stages::validate
