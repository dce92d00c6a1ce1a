// What the case file says of fibres whatever their law.
#pragma once

#include "tunica/config/schema.hpp"
#include "tunica/wall/materials/fibre_energy.hpp"

namespace tunica::wall {

struct FibreOptions {
  bool tension_only = true;  ///< are fibres under compression excluded?
  bool unsplit = false;      ///< do fibres follow C instead of C_bar?
  static config::Schema<FibreOptions> schema();
};

/// Keys k1, k2 of a family.
config::Schema<FibreEnergy> fibre_energy_schema();

/// A member that holds the angle of a mean fibre direction from e1 towards e2: the allowed range [rad].
config::Range fibre_angle_range();

/// At least one family.
void check_families(std::size_t families, config::Problems& problems);

}  // namespace tunica::wall
