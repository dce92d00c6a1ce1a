// A coarse tube of blood and a wall with fibres, whose chain has all stages but `mesh` and `outlets`.
#pragma once

namespace tunica::test {

inline constexpr const char* coarse_tube =
    "meshes:\n"
    "  tube: {radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4}\n"
    "  interface: {lumen: lumen_wall, wall: wall_inner}\n";

/// All else but times, `post` and `report`.
inline constexpr const char* prestressed_tube =
    "analysis: fsi\nelements: linear\n"
    "fluid: {}\n"
    "fibres: {inlet: [wall_inlet, lumen_inlet], outer: wall_outer, mean_angle: 35 deg}\n"
    "wall:\n"
    "  density: 1100 kg/m^3\n"
    "  material: {hgo: {shear_modulus: 40 kPa, poisson_ratio: 0.49, families: [{k1: 60 kPa, k2: 5, "
    "mean_angle: 35 deg}]}}\n"
    "boundary:\n"
    "  lumen_inlet: {flow: 20 ml/s}\n"
    "  lumen_outlet: {resistance: 5e8 Pa s/m^3}\n"
    "  \"wall_*\": fixed\n"
    "  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n"
    "prestress: {flow: {pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: 20}, tolerance: 0.01 mm}\n";

}  // namespace tunica::test
