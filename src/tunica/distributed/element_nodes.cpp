#include "tunica/distributed/element_nodes.hpp"

#include <utility>

#include "tunica/fe/quadratic_tetrahedron.hpp"

namespace tunica::distributed {

std::vector<EdgeNode> edge_nodes(const DistributedMesh& mesh) {
  std::vector<EdgeNode> list;
  std::vector<char> seen(mesh.points.size(), 0);
  for (const auto& region : mesh.regions)
    for (std::size_t e = 0; e < region.edges.size(); ++e)
      for (int k = 0; k < 6; ++k) {
        const auto node = region.edges[e][k];
        if (std::exchange(seen[node], 1) != 0) continue;
        list.push_back(
            {node, {region.elements[e][fe::edge_ends[k][0]], region.elements[e][fe::edge_ends[k][1]]}, region.kind});
      }
  return list;
}

}  // namespace tunica::distributed
