#include "tunica/wall/parameters.hpp"

#include <cmath>

namespace tunica::wall {

namespace {

void check_element(const Parameters& p, config::Problems& problems) {
  if (p.element != Element::displacement) return;
  const double bulk = p.body().volumetric.bulk_modulus, shear = elastic_constants(p.material).shear();
  if (!std::isfinite(bulk)) {
    problems.add("element", "is displacement, which needs a finite bulk modulus, but the material is incompressible",
                 "use element: mixed, or poisson_ratio below 0.5");
    return;
  }
  const double nu = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
  if (nu > 0.45)
    problems.warn("element", "is displacement with a Poisson's ratio of " + std::to_string(nu) + ", where it locks",
                  "use element: mixed");
}

}  // namespace

Body Parameters::body() const {
  return {.density = density,
          .volumetric = {volumetric_energy, elastic_constants(material).bulk()},
          .stabilisation = stabilisation};
}

config::Schema<Parameters> Parameters::schema() {
  return config::Schema<Parameters>("wall", "Solid wall.")
      .choice("element", &Parameters::element, {{"mixed", Element::mixed}, {"displacement", Element::displacement}},
              "Displacement and pressure, right up to incompressibility, or displacement alone, which locks there")
      .by_default()
      .quantity("density", &Parameters::density, config::dimension::density, config::above(0),
                "Density in the reference state")
      .plausible("500 kg/m^3", "3000 kg/m^3")
      .section("material", &Parameters::material, law_schema(), "Law of the wall and its parameters")
      .choice("volumetric_energy", &Parameters::volumetric_energy,
              {{"simo_taylor", VolumetricEnergy::simo_taylor},
               {"quadratic", VolumetricEnergy::quadratic},
               {"miehe", VolumetricEnergy::miehe}},
              "K/4 (J^2 - 1 - 2 ln J), K/2 (J - 1)^2 or K (J - ln J - 1)")
      .by_default()
      .number("stabilisation", &Parameters::stabilisation, config::above(0),
              "Constant c of the mixed element's subscale, c h^2 / mu; larger damps pressure oscillations more")
      .by_default()
      .plausible("0.005", "2")
      .check(check_element);
}

}  // namespace tunica::wall
