// The units that a peer's input file is written in, which it does not say itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"

namespace tunica::peer_cases {

/// Names of the units, as case files have them.
struct UnitSystem {
  const char* name;     ///< "cgs"
  const char* length;   ///< "cm"
  double metres;        ///< of one
  const char* density;  ///< ...
  const char* viscosity;
  const char* pressure;
  const char* velocity;
  const char* flow;
  const char* resistance;
  const char* compliance;
  const char* stiffness_per_area;
  const char* damping_per_area;
  double kilograms_per_cubic_metre;  ///< of one unit of density
};

/// cgs (cm, g, s), mmgs (mm, g, s) or si. Throws InputError for another name, and for none.
const UnitSystem& unit_system(const std::string& name);

/// The unit of coordinates that become `scale` times one of the system's lengths; none when there is no name for it.
std::optional<std::string> scaled_length_unit(const UnitSystem& units, double scale);

/// Is the density of blood one of blood? An error where it would be in another system alone, for then the wrong one was
/// named.
void check_blood_density(const UnitSystem& units, double density, const std::string& where,
                         std::vector<Problem>& problems);

}  // namespace tunica::peer_cases
