#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity vorticity() {
  return {.key = "vorticity",
          .name = "vorticity",
          .help = "curl of the velocity of the blood: mean over the elements at a node",
          .unit = Unit::per_second,
          .place = Place::lumen_nodes,
          .components = 3,
          .of_motion = true,
          .values = [](Moment& moment, std::size_t) {
            const auto& gradients = moment.velocity_gradients();
            std::vector<Values> result(1);
            result[0].stride = 3;
            result[0].own.resize(gradients.size() / 3);
            for (std::size_t n = 0; n < gradients.size() / 9; ++n) {
              const double* g = gradients.data() + 9 * n;
              double* w = result[0].own.data() + 3 * n;
              w[0] = g[7] - g[5], w[1] = g[2] - g[6], w[2] = g[3] - g[1];
            }
            return result;
          }};
}

}  // namespace tunica::quantities
