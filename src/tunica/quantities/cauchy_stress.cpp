#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity cauchy_stress() {
  return {.key = "cauchy_stress",
          .name = "Cauchy stress",
          .help = "tensor, row by row, in the axes of the case",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .components = 9,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 9,
                                     [](const WallPoint& point, double* out) { put(full(point.sigma), out); });
          }};
}

}  // namespace tunica::quantities
