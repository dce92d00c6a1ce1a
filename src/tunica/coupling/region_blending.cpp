#include "tunica/coupling/region_blending.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/wall_filter.hpp"
#include "tunica/distributed/element_shape.hpp"

namespace tunica::coupling {

namespace {

constexpr double negligible = 1e-3;

/// Integral of the indicator of the regions of one material times each shape function, of owned nodes.
std::vector<double> indicator_load(const distributed::DistributedMesh& mesh, const std::vector<int>& material_of_region,
                                   int material) {
  std::vector<double> load(static_cast<std::size_t>(mesh.owned_nodes), 0.0);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    if (material_of_region[r] != material) continue;
    for (const auto& element : mesh.regions[r].elements) {
      const double share = 0.25 * distributed::shape(mesh, element).volume;
      for (const auto node : element)
        if (node < mesh.owned_nodes) load[node] += share;
    }
  }
  return load;
}

/// Negligible weights dropped, the others summing to one.
void tidy(double* weights, int materials) {
  double sum = 0.0;
  for (int m = 0; m < materials; ++m) {
    if (weights[m] < negligible) weights[m] = 0.0;
    sum += weights[m];
  }
  for (int m = 0; m < materials; ++m) weights[m] /= sum;
}

}  // namespace

std::vector<std::vector<double>> blend_regions(const distributed::DistributedMesh& mesh,
                                               const std::vector<int>& material_of_region, int materials,
                                               double length) {
  const auto count = static_cast<std::size_t>(materials);
  std::vector<std::vector<double>> weights(mesh.regions.size());
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (material_of_region[r] >= 0) weights[r].assign(mesh.regions[r].elements.size() * count, 0.0);
  const auto for_each = [&](const auto& visit) {
    for (std::size_t r = 0; r < mesh.regions.size(); ++r)
      if (material_of_region[r] >= 0)
        for (std::size_t e = 0; e < mesh.regions[r].elements.size(); ++e)
          visit(mesh.regions[r].elements[e], weights[r].data() + e * count, material_of_region[r]);
  };
  if (!(length > 0.0) || materials == 1) {
    for_each([](const auto&, double* w, int material) { w[material] = 1.0; });
    return weights;
  }
  assembly::WallFilter filter(mesh, length / (2.0 * std::sqrt(3.0)),
                              "Blending of wall materials (is the smoothing length far larger than the wall?)");
  for (int m = 0; m < materials; ++m) {
    const auto nodal = filter.apply(indicator_load(mesh, material_of_region, m));
    for_each([&](const auto& element, double* w, int) {
      for (const auto node : element) w[m] += 0.25 * nodal[node];
    });
  }
  for_each([&](const auto&, double* w, int) { tidy(w, materials); });
  return weights;
}

}  // namespace tunica::coupling
