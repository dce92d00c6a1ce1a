#include "tunica/coupling/material_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "tunica/base/error.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

/// `corners`: it may have a value for each of the four.
const mesh::ElementField& array_of(const distributed::Region& region, const std::string& key, const std::string& name,
                                   bool corners) {
  for (const auto& field : region.fields) {
    if (field.name != name) continue;
    if (field.components == 1 || (corners && field.components == fe::nodes)) return field;
    throw InputError(key, fmt::format("cell array `{}` has {} components", name, field.components),
                     corners ? "use one of a number, or of four for the corners" : "use a scalar one");
  }
  throw InputError(key, fmt::format("region {} of the wall mesh has no cell array `{}`", region.name, name),
                   "add it to the volume of the wall, or name its file in `meshes.wall.arrays`");
}

/// Of an element, all components.
std::span<const double> values_of(const distributed::Region& region, std::size_t element, const std::string& key,
                                  const std::string& name, bool is_share) {
  const auto& field = array_of(region, key, name, !is_share);
  const auto n = static_cast<std::size_t>(field.components);
  const auto values = std::span(field.values).subspan(n * element, n);
  for (const double value : values)
    if (!std::isfinite(value) || (is_share && !(value >= 0.0 && value <= 1.0)))
      throw InputError(key,
                       fmt::format("`{}` is {:g} in element {} of region {}", name, value,
                                   region.element_ids[element] + 1, region.name),
                       is_share ? "shares lie between 0 and 1" : "give every element a finite number");
  constexpr double rounding = 0.01;  // of a depth that another program has found
  for (const double value : values)
    if (!is_share && !(value >= -rounding && value <= 1 + rounding))
      throw InputError(key,
                       fmt::format("`{}` is {:g} in element {} of region {}", name, value,
                                   region.element_ids[element] + 1, region.name),
                       "a depth lies between 0 at the inner and 1 at the outer surface");
  return values;
}

/// Between values at the corners, or that of all of the element.
double value_at(std::span<const double> values, const double (&barycentric)[fe::nodes]) {
  if (values.size() == 1) return values[0];
  double sum = 0.0;
  for (int a = 0; a < fe::nodes; ++a) sum += barycentric[a] * values[static_cast<std::size_t>(a)];
  return sum;
}

/// Of one composition in an element: at its centroid, then at so many points.
std::vector<std::vector<double>> weights_of(const wall::Composition& composition, const distributed::Region& region,
                                            std::size_t element, int points) {
  constexpr double centroid[fe::nodes] = {0.25, 0.25, 0.25, 0.25}, none[1] = {0.0};
  std::span<const double> depth(none);
  if (composition.layers) depth = values_of(region, element, "wall.layers.depth", composition.layers->depth, false);
  const double share = composition.admixture
                           ? values_of(region, element, "wall.admixture.share", composition.admixture->share, true)[0]
                           : 0.0;
  std::vector<std::vector<double>> rows{composition.weights(value_at(depth, centroid), share)};
  for (int q = 0; q < points; ++q)
    rows.push_back(composition.weights(
        value_at(depth, fe::quadratic_four_points[static_cast<std::size_t>(q)].barycentric), share));
  return rows;
}

}  // namespace

int weight_points(const distributed::DistributedMesh& mesh, const std::vector<const wall::Composition*>& compositions) {
  const bool layered =
      std::any_of(compositions.begin(), compositions.end(), [](const auto* c) { return c->layers.has_value(); });
  return mesh.quadratic && layered ? static_cast<int>(fe::quadratic_four_points.size()) : 0;
}

std::vector<std::vector<double>> material_weights(const distributed::DistributedMesh& mesh,
                                                  const std::vector<const wall::Composition*>& compositions,
                                                  const std::vector<std::vector<double>>& of_composition) {
  const int points = weight_points(mesh, compositions);
  return parallel::agree(mesh.comm, [&] {
    std::vector<std::vector<double>> result(mesh.regions.size());
    for (std::size_t r = 0; r < mesh.regions.size(); ++r)
      for (std::size_t e = 0; e * compositions.size() < of_composition[r].size(); ++e) {
        std::vector<std::vector<double>> rows(1 + static_cast<std::size_t>(points));
        for (std::size_t m = 0; m < compositions.size(); ++m) {
          const double share = of_composition[r][e * compositions.size() + m];
          const std::vector<double> none(1 + compositions[m]->further().size());
          const auto weights =
              share > 0.0 ? weights_of(*compositions[m], mesh.regions[r], e, points) : std::vector(rows.size(), none);
          for (std::size_t k = 0; k < rows.size(); ++k)
            for (const double weight : weights[k]) rows[k].push_back(share * weight);
        }
        for (const auto& row : rows) result[r].insert(result[r].end(), row.begin(), row.end());
      }
    return result;
  });
}

}  // namespace tunica::coupling
