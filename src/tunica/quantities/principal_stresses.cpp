#include "tunica/quantities/list.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::quantities {

Quantity principal_stresses() {
  return {.key = "principal_stresses",
          .name = "principal stresses",
          .help = "largest first",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .components = 3,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 3, [](const WallPoint& point, double* out) {
              const auto s = wall::principal_stresses(point.sigma);
              out[0] = s[0], out[1] = s[1], out[2] = s[2];
            });
          }};
}

}  // namespace tunica::quantities
