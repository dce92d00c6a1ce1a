#include "tunica/coupling/material_weights.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

const mesh::ElementField& array_of(const distributed::Region& region, const std::string& key, const std::string& name) {
  for (const auto& field : region.fields) {
    if (field.name != name) continue;
    if (field.components == 1) return field;
    throw InputError(key, fmt::format("cell array `{}` has {} components", name, field.components), "use a scalar one");
  }
  throw InputError(key, fmt::format("region {} of the wall mesh has no cell array `{}`", region.name, name),
                   "add it to the volume of the wall, or name its file in `meshes.wall.arrays`");
}

double value_of(const distributed::Region& region, std::size_t element, const std::string& key, const std::string& name,
                bool is_share) {
  const double value = array_of(region, key, name).values[element];
  if (std::isfinite(value) && (!is_share || (value >= 0.0 && value <= 1.0))) return value;
  throw InputError(
      key,
      fmt::format("`{}` is {:g} in element {} of region {}", name, value, region.element_ids[element] + 1, region.name),
      is_share ? "shares lie between 0 and 1" : "give every element a finite number");
}

/// Of one composition in an element.
std::vector<double> weights_of(const wall::Composition& composition, const distributed::Region& region,
                               std::size_t element) {
  const double depth =
      composition.layers ? value_of(region, element, "wall.layers.depth", composition.layers->depth, false) : 0.0;
  const double share = composition.admixture
                           ? value_of(region, element, "wall.admixture.share", composition.admixture->share, true)
                           : 0.0;
  return composition.weights(depth, share);
}

}  // namespace

std::vector<std::vector<double>> material_weights(const distributed::DistributedMesh& mesh,
                                                  const std::vector<const wall::Composition*>& compositions,
                                                  const std::vector<std::vector<double>>& of_composition) {
  return parallel::agree(mesh.comm, [&] {
    std::vector<std::vector<double>> result(mesh.regions.size());
    for (std::size_t r = 0; r < mesh.regions.size(); ++r)
      for (std::size_t e = 0; e * compositions.size() < of_composition[r].size(); ++e)
        for (std::size_t m = 0; m < compositions.size(); ++m) {
          const double share = of_composition[r][e * compositions.size() + m];
          const std::vector<double> weights = share > 0.0 ? weights_of(*compositions[m], mesh.regions[r], e)
                                                          : std::vector<double>(1 + compositions[m]->further().size());
          for (const double weight : weights) result[r].push_back(share * weight);
        }
    return result;
  });
}

}  // namespace tunica::coupling
