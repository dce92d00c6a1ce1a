#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity acceleration() {
  return {.key = "acceleration",
          .name = "acceleration",
          .help = "of blood and wall, at nodes that move with the mesh, in m/s^2",
          .unit = Unit::metre_per_second_squared,
          .place = Place::nodes,
          .components = 3,
          .of_motion = true,
          .values = [](Moment& moment, std::size_t) { return seen(moment.state().acceleration, 4); }};
}

}  // namespace tunica::quantities
