#include "tunica/quantities/list.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::quantities {

Quantity first_principal_stress() {
  return {.key = "first_principal_stress",
          .name = "first principal stress",
          .help = "largest principal stress",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .components = 1,
          .standard = true,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 1, [](const WallPoint& point, double* out) {
              *out = wall::principal_stresses(point.sigma)[0];
            });
          }};
}

}  // namespace tunica::quantities
