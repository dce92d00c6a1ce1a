#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity jacobian() {
  return {.key = "jacobian",
          .name = "Jacobian",
          .help = "volume over that of the stress-free state",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .components = 1,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 1,
                                     [](const WallPoint& point, double* out) { *out = determinant(point.F); });
          }};
}

}  // namespace tunica::quantities
