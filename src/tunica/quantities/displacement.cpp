#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity displacement() {
  return {.key = "displacement",
          .name = "displacement",
          .help = "of the wall, and of the mesh of the lumen with it",
          .unit = Unit::length,
          .place = Place::nodes,
          .components = 3,
          .standard = true,
          .given = has_wall,
          .values = [](Moment& moment, std::size_t) { return seen(moment.state().displacement, 4); }};
}

}  // namespace tunica::quantities
