#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity wall_shear_stress() {
  return {.key = "wall_shear_stress",
          .name = "wall shear stress",
          .help = "what the flow does along the wall; zero off the wall",
          .unit = Unit::pascal,
          .place = Place::lumen_nodes,
          .components = 3,
          .standard = true,
          .values = [](Moment& moment, std::size_t) { return seen(moment.wall_shear_stresses(), 3); }};
}

}  // namespace tunica::quantities
