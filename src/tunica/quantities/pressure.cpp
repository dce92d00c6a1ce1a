#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity pressure() {
  return {.key = "pressure",
          .name = "pressure",
          .help = "of the blood",
          .unit = Unit::pressure,
          .place = Place::lumen_nodes,
          .standard = true,
          .values = [](Moment& moment, std::size_t) { return seen(moment.state().velocity_pressure, 4, 3); }};
}

}  // namespace tunica::quantities
