#include "tunica/wall/materials/fibre_options.hpp"

#include <numbers>

namespace tunica::wall {

config::Schema<FibreOptions> FibreOptions::schema() {
  return config::Schema<FibreOptions>("fibre_options", "How fibres enter.")
      .choice("exclusion", &FibreOptions::tension_only, {{"tension_only", true}, {"none", false}},
              "Are fibres under compression left out? The switch tests the strain that the energy uses")
      .by_default()
      .choice("fibre_energy", &FibreOptions::unsplit, {{"isochoric", false}, {"unsplit", true}},
              "Fibres follow the isochoric strain, or the strain as it is (Nolan et al. 2014)")
      .by_default();
}

config::Schema<FibreEnergy> fibre_energy_schema() {
  return config::Schema<FibreEnergy>("fibre_energy", "k1/(2 k2) {exp[k2 (I - 1)^2] - 1}.")
      .quantity("k1", &FibreEnergy::k1, config::dimension::pressure, config::at_least(0), "Stress-like parameter")
      .plausible("1 Pa", "10 MPa")
      .number("k2", &FibreEnergy::k2, config::at_least(0), "Stiffening; 0 gives k1/2 (I - 1)^2")
      .plausible("0", "500");
}

config::Range fibre_angle_range() { return config::range(-std::numbers::pi, std::numbers::pi); }

void check_families(std::size_t families, config::Problems& problems) {
  if (families == 0) problems.add("families", "is empty", "list at least one family, or use neo_hooke");
}

}  // namespace tunica::wall
