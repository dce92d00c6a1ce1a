#include "tunica/wall/materials/aortic_tissue.hpp"

#include <numbers>

namespace tunica::wall {

namespace {

/// Moduli in kPa, angle in degrees.
DfdParameters two_families(double shear_modulus, double k1, double k2, double angle, double in_plane = 2.54) {
  constexpr double out_of_plane = 19.44;
  DfdParameters p;
  p.elastic = {.shear_modulus = 1e3 * shear_modulus, .poisson_ratio = 0.49};
  for (const double side : {1.0, -1.0}) {
    dfd::Family family;
    family.energy = {1e3 * k1, k2};
    family.orientation = dfd::Bivariate{in_plane, out_of_plane, side * angle * std::numbers::pi / 180.0};
    p.families.push_back(family);
  }
  return p;
}

}  // namespace

DfdParameters aortic_tissue(AorticTissue tissue) {
  switch (tissue) {
    case AorticTissue::false_lumen_wall:
      return two_families(100.0, 90.0, 8.0, 40.0);
    case AorticTissue::flap:
      return two_families(80.0, 30.0, 4.0, 25.0);
    case AorticTissue::chronic_adventitia:
      return two_families(61.0, 11.3, 12.6, 38.0, 2.9);
    case AorticTissue::true_lumen_wall:
      break;
  }
  return two_families(100.0, 60.0, 5.0, 35.0);
}

}  // namespace tunica::wall
