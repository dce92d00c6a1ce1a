#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity principal_directions() {
  return {.key = "principal_directions",
          .name = "principal directions",
          .help = "unit vectors of the principal stresses, row by row in their order; signs have no meaning",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .components = 9,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 9, [](const WallPoint& point, double* out) {
              const auto& s = point.sigma;
              put(frames::principal_axes({s[0], s[1], s[2], s[3], s[4], s[5]}).directions, out);
            });
          }};
}

}  // namespace tunica::quantities
