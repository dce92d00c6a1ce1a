#include "tunica/quantities/fibres.hpp"
#include "tunica/quantities/list.hpp"

namespace tunica::quantities {

Quantity fibre_stretch() {
  return {.key = "fibre_stretch",
          .name = "stretch along fibres",
          .help = "of the mean direction of each family, from the stress-free state",
          .unit = Unit::none,
          .place = Place::wall_elements,
          .values = [](Moment& moment, std::size_t region) {
            return for_fibres(moment, region, [](const WallPoint& point, const Vec3<double>& M) {
              return norm(point.F * M) / norm(M);
            });
          }};
}

}  // namespace tunica::quantities
