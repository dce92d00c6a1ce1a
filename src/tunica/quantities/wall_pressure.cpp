#include "tunica/quantities/list.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::quantities {

Quantity wall_pressure() {
  return {
      .key = "wall_pressure",
      .name = "wall pressure",
      .help = "unknown of the mixed element: minus the mean stress",
      .unit = Unit::pressure,
      .place = Place::wall_nodes,
      .standard = true,
      .given = [](const coupling::Problem& problem) { return problem.input().wall->element == wall::Element::mixed; },
      .values = [](Moment& moment, std::size_t) { return seen(moment.state().velocity_pressure, 4, 3); }};
}

}  // namespace tunica::quantities
