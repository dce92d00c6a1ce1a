#include "tunica/quantities/list.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::quantities {

Quantity von_mises_stress() {
  return {.key = "von_mises_stress",
          .name = "von Mises stress",
          .help = "equivalent stress",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .components = 1,
          .standard = true,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 1,
                                     [](const WallPoint& point, double* out) { *out = wall::von_mises(point.sigma); });
          }};
}

}  // namespace tunica::quantities
