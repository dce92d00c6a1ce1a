// Walls alone, in equilibrium with their loads.
#include <fmt/format.h>

#include <cmath>

#include "tunica/mesh/generate.hpp"
#include "tunica/stages/validate/benchmark.hpp"

namespace tunica::stages::validate {

namespace {

constexpr const char* wall_mesh =
    "meshes:\n"
    "  length_unit: m\n"
    "  wall: {simvascular: wall, region_array: region, regions: {wall: 1}}\n";
constexpr const char* units = "  units: {length: m, time: s, velocity: m/s, pressure: Pa, stress: Pa, flow: m^3/s}\n";

// --- clamped strip ------------------------------------------------------------------------------------------------

struct Strip {
  double length = 25e-3, thickness = 2e-3, depth = 2e-3;  // m
  double young = 400e3, poisson = 0.4, pressure = 1.0;    // Pa
  /// Plane strain; Timoshenko's shear with 5/6 (1 % here) beside Kirchhoff's bending.
  double deflection() const {
    const double stiffness = young * std::pow(thickness, 3) / (12 * (1 - poisson * poisson));
    const double shear = young / (2 * (1 + poisson)) * thickness * 5 / 6;
    return pressure * std::pow(length, 4) / (8 * stiffness) + pressure * length * length / (2 * shear);
  }
};

Posed strip_case(const Variant& v) {
  const Strip s;
  const int along = v.full ? 24 : 16, through = v.full ? 2 : 1;
  return {.case_text = "title: Clamped strip under pressure\nanalysis: {static_wall: {load_steps: 1}}\n" +
                       elements_line(v) + wall_mesh +
                       fmt::format("wall:\n"
                                   "  density: 1000 kg/m^3\n"
                                   "  material: {{neo_hooke: {{young_modulus: {} Pa, poisson_ratio: {}}}}}\n"
                                   "boundary:\n"
                                   "  x_min: fixed\n"
                                   "  x_max: free\n"
                                   "  y_min: {{pressure: {{value: {} Pa, follower: false}}}}\n"
                                   "  y_max: free\n"
                                   "  z_min: symmetry\n"
                                   "  z_max: symmetry\n"
                                   "newton: {{relative_tolerance: 1e-8}}\n"
                                   "linear: {{tolerance: 1e-6, max_iterations: 3000, restart: 1000}}\n"
                                   "output:\n"
                                   "  points: {{tip: [{} m, {} m, {} m]}}\n",
                                   s.young, s.poisson, s.pressure, s.length, 0.5 * s.thickness, 0.5 * s.depth) +
                       units,
          .mesh = mesh::box(along, through, 1, {{s.length, s.thickness, s.depth}}, mesh::RegionKind::wall)};
}

// --- thick tube ---------------------------------------------------------------------------------------------------

struct ThickTube {
  double inner = 10e-3, outer = 15e-3, length = 4e-3;  // m
  double shear = 50e3, pressure = 10e3;                // Pa

  /// Incompressible neo-Hooke in plane strain: p = mu * integral of (r^2/R^2 - R^2/r^2) dr/r from the inner to the
  /// outer face, with r^2 = R^2 + k (Holzapfel 2000, section 6.6 for the equilibrium; the integral by Simpson's rule).
  double pressure_at(double displacement) const {
    const double k = (inner + displacement) * (inner + displacement) - inner * inner;
    constexpr int n = 2000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double R = inner + (outer - inner) * i / n, square = R * R + k, ratio = square / (R * R);
      const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * (ratio - 1 / ratio) * R / square;  // dr/r = R dR/r^2
    }
    return shear * sum * (outer - inner) / (3 * n);
  }
  double displacement() const {
    double low = 0, high = inner;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (pressure_at(middle) < pressure ? low : high) = middle;
    }
    return low;
  }
};

Posed tube_case(const Variant& v) {
  const ThickTube t;
  const int around = v.full ? 16 : 8, radial = v.full ? 4 : 2;
  return {.case_text = "title: Thick tube under pressure\nanalysis: {static_wall: {load_steps: 4}}\n" +
                       elements_line(v) + wall_mesh +
                       fmt::format("wall:\n"
                                   "  density: 1000 kg/m^3\n"
                                   "  material: {{neo_hooke: {{shear_modulus: {} Pa, poisson_ratio: 0.5}}}}\n"
                                   "boundary:\n"
                                   "  wall_inner: {{pressure: {} Pa}}\n"
                                   "  wall_outer: free\n"
                                   "  wall_inlet: symmetry\n"
                                   "  wall_outlet: symmetry\n"
                                   "  symmetry_x: symmetry\n"
                                   "  symmetry_y: symmetry\n"
                                   "newton: {{relative_tolerance: 1e-7}}\n"
                                   "output:\n"
                                   "  points: {{inner: [{} m, 0 m, 0 m], outer: [{} m, 0 m, 0 m]}}\n",
                                   t.shear, t.pressure, t.inner, t.outer) +
                       units,
          .mesh = mesh::thick_cylinder({.inner = t.inner,
                                        .outer = t.outer,
                                        .length = t.length,
                                        .cells_radial = radial,
                                        .cells_around = around,
                                        .cells_along = 1},
                                       mesh::Sector::quarter)};
}

}  // namespace

std::vector<Benchmark> wall_benchmarks() {
  const ThickTube tube;
  const double inner = tube.displacement(), k = (tube.inner + inner) * (tube.inner + inner) - tube.inner * tube.inner;
  return {
      {.name = "clamped_strip",
       .title = "Clamped strip under pressure, plane strain",
       .source = "Beam theory: Kirchhoff's bending with (1 - nu^2) and Timoshenko's shear (5/6)",
       .references = {{"deflection of the end", "m", Strip{}.deflection(), 0, 0.05, 0.02}},
       .pose = strip_case,
       .measure = [](const Results& r) { return std::vector{r.last("points", "tip displacement y [m]")}; }},
      {.name = "thick_tube",
       .title = "Thick incompressible tube under pressure, quarter between planes of symmetry",
       .source = "Closed form of the incompressible neo-Hooke tube in plane strain (Holzapfel 2000)",
       .references = {{"displacement of the inner face", "m", inner, 0, 0.02, 0.005},
                      {"displacement of the outer face", "m", std::sqrt(tube.outer * tube.outer + k) - tube.outer, 0,
                       0.02, 0.005}},
       .pose = tube_case,
       .measure =
           [](const Results& r) {
             return std::vector{r.last("points", "inner displacement x [m]"),
                                r.last("points", "outer displacement x [m]")};
           }},
  };
}

}  // namespace tunica::stages::validate
