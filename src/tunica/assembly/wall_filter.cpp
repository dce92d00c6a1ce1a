#include "tunica/assembly/wall_filter.hpp"

#include "tunica/distributed/element_shape.hpp"

namespace tunica::assembly {

namespace {

/// Nodes outside the wall have a row of their own.
ScalarEntries entries(const distributed::DistributedMesh& mesh, double l) {
  ScalarEntries result;
  std::vector<char> in_wall(static_cast<std::size_t>(mesh.owned_nodes), 0);
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::wall) continue;
    for (const auto& element : region.elements) {
      const auto g = distributed::shape(mesh, element);
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

}  // namespace

WallFilter::WallFilter(const distributed::DistributedMesh& mesh, double length, const std::string& name)
    : system_(mesh, entries(mesh, length), name) {}

}  // namespace tunica::assembly
