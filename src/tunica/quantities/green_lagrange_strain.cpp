#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity green_lagrange_strain() {
  return {.key = "green_lagrange_strain",
          .name = "Green-Lagrange strain",
          .help =
              "from the stress-free state, row by row, in the axes of the material (those of the case where it has no "
              "fibres)",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .components = 9,
          .values = [](Moment& moment, std::size_t region) {
            return for_wall_elements(moment, region, 9, [](const WallPoint& point, double* out) {
              put(0.5 * (transpose(point.F) * point.F + (-1.0) * identity<double>()), out);
            });
          }};
}

}  // namespace tunica::quantities
