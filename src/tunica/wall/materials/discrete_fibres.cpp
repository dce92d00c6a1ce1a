#include "tunica/wall/materials/discrete_fibres.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tunica::wall {

FibreBundle FibreBundle::make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                              std::span<const double> densities) {
  constexpr double equal = 1e-12;
  FibreBundle bundle{energy, {}, directions.size()};
  std::multimap<double, std::size_t> single;  // pairs without a second direction, by |N1|
  std::vector<Vec3<double>> firsts;
  for (std::size_t n = 0; n < directions.size(); ++n) {
    const Vec3<double>& N = directions[n];
    const Vec3<double> mirrored{{N[0], N[1], -N[2]}};
    const double key = std::abs(N[0]);
    const auto last = single.upper_bound(key + equal);
    const auto found = std::find_if(single.lower_bound(key - equal), last, [&](const auto& entry) {
      const Vec3<double>& other = firsts[entry.second];
      return std::min(norm(other - mirrored), norm(other + mirrored)) <= equal;
    });
    if (found != last) {
      bundle.pairs[found->second].density[1] = densities[n];
      single.erase(found);
      continue;
    }
    Pair pair{.NN = {}, .density = {densities[n], 0.0}};
    for (int v = 0; v < voigt_size; ++v) pair.NN[v] = N[voigt_row[v]] * N[voigt_column[v]];
    single.emplace(key, bundle.pairs.size());
    bundle.pairs.push_back(pair);
    firsts.push_back(N);
  }
  return bundle;
}

}  // namespace tunica::wall
