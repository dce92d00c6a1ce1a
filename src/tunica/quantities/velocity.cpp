#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity velocity() {
  return {.key = "velocity",
          .name = "velocity",
          .help = "of blood and wall",
          .unit = Unit::velocity,
          .place = Place::nodes,
          .components = 3,
          .standard = true,
          .of_motion = true,
          .values = [](Moment& moment, std::size_t) -> std::vector<Values> {
            return seen(moment.state().velocity_pressure, 4);
          }};
}

}  // namespace tunica::quantities
