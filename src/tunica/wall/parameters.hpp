// The wall section of the case file.
#pragma once

#include "tunica/config/schema.hpp"
#include "tunica/wall/element.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::wall {

enum class Element {
  mixed,        ///< displacement and pressure, stabilised; right up to incompressibility
  displacement  ///< displacement only; locks when nearly incompressible
};

struct Parameters {
  Element element = Element::mixed;
  double density = 0.0;  ///< rho_0 [kg/m^3]
  LawParameters material;
  VolumetricEnergy volumetric_energy = VolumetricEnergy::simo_taylor;
  double stabilisation = default_stabilisation;  ///< c in tau_u = c h^2 / mu [-]

  Law law() const { return make_law(material); }
  Body body() const;

  /// Keys element, density, material, volumetric_energy, stabilisation. An incompressible law with the displacement
  /// element is an error.
  static config::Schema<Parameters> schema();
};

}  // namespace tunica::wall
