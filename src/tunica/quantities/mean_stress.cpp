#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity mean_stress() {
  return {.key = "mean_stress",
          .name = "mean stress",
          .help = "a third of the trace of the Cauchy stress",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .components = 1,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 1, [](const WallPoint& point, double* out) {
              *out = (point.sigma[0] + point.sigma[1] + point.sigma[2]) / 3.0;
            });
          }};
}

}  // namespace tunica::quantities
