#include "tunica/wall/materials/discrete_fibres.hpp"

#include "tunica/wall/fibres/directions.hpp"

namespace tunica::wall {

FibreBundle FibreBundle::make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                              std::span<const double> densities) {
  FibreBundle bundle{energy, {}, directions.size()};
  DirectionIndex firsts;  // of the pairs
  for (std::size_t n = 0; n < directions.size(); ++n) {
    const Vec3<double>& N = directions[n];
    if (const auto pair = firsts.find({{N[0], N[1], -N[2]}})) {
      bundle.pairs[*pair].density[1] = densities[n];
      continue;
    }
    Pair pair{.NN = {}, .density = {densities[n], 0.0}};
    for (int v = 0; v < voigt_size; ++v) pair.NN[v] = N[voigt_row[v]] * N[voigt_column[v]];
    bundle.pairs.push_back(pair);
    firsts.add(N);
  }
  return bundle;
}

}  // namespace tunica::wall
