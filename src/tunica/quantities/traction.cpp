#include "tunica/coupling/nodal.hpp"
#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity traction() {
  return {.key = "traction",
          .name = "traction",
          .help = "what the blood does to the wall, pressure and wall shear; zero off the wall",
          .unit = Unit::pascal,
          .place = Place::lumen_nodes,
          .components = 3,
          .values = [](Moment& moment, std::size_t) {
            const auto &shear = moment.wall_shear_stresses(), &normals = moment.inside_normals();
            std::vector<Values> result(1);
            result[0].stride = 3;
            result[0].own.resize(shear.size());
            for (std::size_t i = 0; i < shear.size(); ++i)
              result[0].own[i] = shear[i] + moment.state().velocity_pressure[4 * (i / 3) + 3] * normals[i];
            return result;
          }};
}

}  // namespace tunica::quantities
