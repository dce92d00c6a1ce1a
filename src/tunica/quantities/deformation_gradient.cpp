#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity deformation_gradient() {
  return {.key = "deformation_gradient",
          .name = "deformation gradient",
          .help =
              "from the stress-free state, row by row; columns are the images of the axes of the material, those of "
              "the case where it has no fibres",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .components = 9,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 9, [](const WallPoint& point, double* out) { put(point.F, out); });
          }};
}

}  // namespace tunica::quantities
