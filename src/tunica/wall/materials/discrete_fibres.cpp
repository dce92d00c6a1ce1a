#include "tunica/wall/materials/discrete_fibres.hpp"

namespace tunica::wall {

FibreBundle FibreBundle::make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                              std::span<const double> densities) {
  FibreBundle bundle{energy, {}};
  for (std::size_t n = 0; n < directions.size(); ++n) {
    Direction d{.NN = {}, .density = densities[n]};
    for (int v = 0; v < voigt_size; ++v) d.NN[v] = directions[n][voigt_row[v]] * directions[n][voigt_column[v]];
    bundle.directions.push_back(d);
  }
  return bundle;
}

}  // namespace tunica::wall
