#include "tunica/wall/materials/discrete_fibres.hpp"

#include <algorithm>
#include <array>

#include "tunica/wall/fibres/directions.hpp"

namespace tunica::wall {

namespace {

/// A direction and the densities of its four images.
struct Images {
  Vec3<double> N;
  std::array<double, 4> density{};
  std::array<bool, 4> present{};
};

Vec3<double> image(const Vec3<double>& N, int i) { return {{N[0], i > 1 ? -N[1] : N[1], i % 2 == 1 ? -N[2] : N[2]}}; }

std::vector<Images> find_images(std::span<const Vec3<double>> directions, std::span<const double> densities) {
  std::vector<Images> groups;
  DirectionIndex firsts;  // of the groups
  const auto known = [&](std::size_t n) {
    for (int i = 0; i < 4; ++i)
      if (const auto group = firsts.find(image(directions[n], i))) {
        groups[*group].density[i] += densities[n];
        groups[*group].present[i] = true;
        return true;
      }
    return false;
  };
  for (std::size_t n = 0; n < directions.size(); ++n) {
    if (known(n)) continue;
    groups.push_back({directions[n], {densities[n]}, {true}});
    firsts.add(directions[n]);
  }
  return groups;
}

template <int images>
FibreGroup<images> make_group(const Images& of) {
  const Vec3<double>& N = of.N;
  FibreGroup<images> group;
  double* NN = group.products;
  for (int v = 0; v < voigt_size; ++v) NN[v] = N[voigt_row[v]] * N[voigt_column[v]];
  double* next = NN + voigt_size;
  for (int row = 0; row < 3; ++row)
    for (int v = row; v < voigt_size; ++v) *next++ = NN[row] * NN[v];
  for (int i = 0; i < images; ++i) group.density[i] = of.density[i];
  return group;
}

}  // namespace

FibreBundle FibreBundle::make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                              std::span<const double> densities) {
  FibreBundle bundle{energy, {}, {}, directions.size()};
  for (const Images& images : find_images(directions, densities)) {
    if (images.present[2] || images.present[3])
      bundle.fours.push_back(make_group<4>(images));
    else
      bundle.pairs.push_back(make_group<2>(images));
  }
  return bundle;
}

}  // namespace tunica::wall
