// The wall section of the case file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "tunica/config/schema.hpp"
#include "tunica/wall/composition.hpp"
#include "tunica/wall/element.hpp"
#include "tunica/wall/fibre_frame.hpp"
#include "tunica/wall/material.hpp"
#include "tunica/wall/viscosity.hpp"

namespace tunica::wall {

enum class Element {
  mixed,        ///< displacement and pressure, stabilised; right up to incompressibility
  displacement  ///< displacement only; locks when nearly incompressible
};

/// What a region of the wall has of its own.
struct RegionMaterial {
  std::optional<double> density;  ///< rho_0 [kg/m^3]; else that of the wall
  LawParameters material;
  Composition composition;  ///< of `material` and others
  static config::Schema<RegionMaterial> schema();
};

/// The key volumetric_energy.
config::Schema<VolumetricEnergy> volumetric_energy_schema();

struct Parameters {
  Element element = Element::mixed;
  double density = 0.0;     ///< rho_0 [kg/m^3]
  LawParameters material;   ///< of all regions that `regions` does not name
  Composition composition;  ///< of these, of `material` and others
  std::map<std::string, RegionMaterial> regions;
  std::optional<double> smoothing_length;  ///< over which one material turns into the next [m]; 0: they jump
  std::optional<FrameSource> fibre_frame;
  std::optional<std::filesystem::path> prestress;  ///< file of `tunica prestress`
  VolumetricEnergy volumetric_energy = VolumetricEnergy::simo_taylor;
  double stabilisation = default_stabilisation;  ///< c in tau_u = c h^2 / mu [-]
  std::optional<Viscosity> viscosity;

  /// Cell arrays that directions and compositions are read from.
  std::vector<std::string> cell_arrays() const;

  /// Of the regions that `regions` does not name.
  Law law() const { return make_law(material); }
  Body body() const;

  /// An incompressible law with the displacement element, and a law with fibres but no fibre frame, are errors.
  static config::Schema<Parameters> schema();
};

}  // namespace tunica::wall
