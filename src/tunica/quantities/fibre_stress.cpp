#include "tunica/quantities/fibres.hpp"
#include "tunica/quantities/list.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::quantities {

Quantity fibre_stress() {
  return {.key = "fibre_stress",
          .name = "stress along fibres",
          .help = "Cauchy stress along the mean direction of each family that the law of a region has",
          .unit = Unit::stress,
          .place = Place::wall_elements,
          .standard = true,
          .values = [](Moment& moment, std::size_t region) {
            return for_fibres(moment, region, [](const WallPoint& point, const Vec3<double>& M) {
              return wall::fibre_stress(point.F, point.sigma, M);
            });
          }};
}

}  // namespace tunica::quantities
