#include "tunica/ale/parameters.hpp"

#include "tunica/config/schema.hpp"

namespace tunica::ale {

using namespace config;

Schema<Parameters> Parameters::schema() {
  return Schema<Parameters>("mesh_motion", "Elastic extension of the motion of the wall into the lumen.")
      .number("poisson_ratio", &Parameters::poisson_ratio, between(-1, 0.5), "Of the pseudo-elastic medium")
      .by_default()
      .number("stiffening_exponent", &Parameters::stiffening_exponent, range(0, 3),
              "Small elements are stiffer by (mean volume / volume) to this power")
      .by_default()
      .number("minimum_quality", &Parameters::minimum_quality, range(0, 1),
              "Least admissible scaled Jacobian of an element, relative to that in the initial mesh")
      .by_default();
}

}  // namespace tunica::ale
