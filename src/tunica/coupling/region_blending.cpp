#include "tunica/coupling/region_blending.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/scalar_system.hpp"
#include "tunica/mesh/element_shape.hpp"

namespace tunica::coupling {

namespace {

constexpr double negligible = 1e-3;

/// w - l^2 div grad w on the nodes of the wall; other nodes have a row of their own.
class Filter {
 public:
  Filter(const mesh::DistributedMesh& mesh, double l)
      : mesh_(mesh),
        system_(mesh, entries(mesh, l),
                "Blending of wall materials (is the smoothing length far larger than the wall?)") {}

  /// Filtered indicator of the regions of one material, [local node].
  std::vector<double> apply(const std::vector<int>& material_of_region, int material) {
    std::vector<double> b(static_cast<std::size_t>(mesh_.owned_nodes), 0.0);
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      if (material_of_region[r] != material) continue;
      for (const auto& element : mesh_.regions[r].elements) {
        const double share = 0.25 * mesh::shape(mesh_, element).volume;
        for (const auto node : element)
          if (node < mesh_.owned_nodes) b[node] += share;
      }
    }
    return system_.solve(b);
  }

 private:
  static assembly::ScalarEntries entries(const mesh::DistributedMesh& mesh, double l) {
    assembly::ScalarEntries result;
    std::vector<char> in_wall(static_cast<std::size_t>(mesh.owned_nodes), 0);
    for (const auto& region : mesh.regions) {
      if (region.kind != mesh::RegionKind::wall) continue;
      for (const auto& element : region.elements) {
        const auto g = mesh::shape(mesh, element);
        for (int a = 0; a < 4; ++a) {
          if (element[a] >= mesh.owned_nodes) continue;
          in_wall[element[a]] = 1;
          for (int b = 0; b < 4; ++b)
            result.add(mesh.global_ids[element[a]], mesh.global_ids[element[b]],
                       g.volume * (l * l * dot(g.dN[a], g.dN[b]) + (a == b ? 0.1 : 0.05)));
        }
      }
    }
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      if (!in_wall[i]) result.add(mesh.global_ids[i], mesh.global_ids[i], 1.0);
    return result;
  }

  const mesh::DistributedMesh& mesh_;
  assembly::ScalarSystem system_;
};

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

std::vector<std::vector<double>> blend_regions(const mesh::DistributedMesh& mesh,
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
  Filter filter(mesh, length / (2.0 * std::sqrt(3.0)));
  for (int m = 0; m < materials; ++m) {
    const auto nodal = filter.apply(material_of_region, m);
    for_each([&](const auto& element, double* w, int) {
      for (const auto node : element) w[m] += 0.25 * nodal[node];
    });
  }
  for_each([&](const auto&, double* w, int) { tidy(w, materials); });
  return weights;
}

}  // namespace tunica::coupling
