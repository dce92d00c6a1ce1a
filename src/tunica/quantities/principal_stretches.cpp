#include <cmath>

#include "tunica/frames/symmetric_tensor.hpp"
#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity principal_stretches() {
  return {.key = "principal_stretches",
          .name = "principal stretches",
          .help = "from the stress-free state, largest first",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .components = 3,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 3, [](const WallPoint& point, double* out) {
              const auto c = full(wall::right_cauchy_green(point.F));
              const auto s = frames::principal_axes({c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(0, 2)}).values;
              for (int i = 0; i < 3; ++i) out[i] = std::sqrt(s[i]);
            });
          }};
}

}  // namespace tunica::quantities
