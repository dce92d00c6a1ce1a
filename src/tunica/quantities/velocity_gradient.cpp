#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity velocity_gradient() {
  return {.key = "velocity_gradient",
          .name = "velocity gradient",
          .help = "dv_i / dx_j of the blood, row by row: mean over the elements at a node",
          .unit = Unit::per_second,
          .place = Place::lumen_nodes,
          .components = 9,
          .of_motion = true,
          .values = [](Moment& moment, std::size_t) { return seen(moment.velocity_gradients(), 9); }};
}

}  // namespace tunica::quantities
