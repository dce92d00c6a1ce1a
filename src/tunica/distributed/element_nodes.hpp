// The nodes of elements, linear or quadratic.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::distributed {

/// A node in the middle of an edge.
struct EdgeNode {
  std::int32_t node, ends[2];  ///< local
  mesh::RegionKind kind;       ///< of its region
};

/// Those of all elements that this rank sees, each once; none for linear elements.
std::vector<EdgeNode> edge_nodes(const DistributedMesh& mesh);

/// Calls visit(node) for the corners of an element, then for the nodes on its edges.
template <class Visit>
void for_each_node(const Region& region, std::size_t element, Visit visit) {
  for (const auto node : region.elements[element]) visit(node);
  if (region.edges.empty()) return;
  for (const auto node : region.edges[element]) visit(node);
}

/// The same for all elements of a region: nodes are met repeatedly.
template <class Visit>
void for_each_node(const Region& region, Visit visit) {
  for (std::size_t e = 0; e < region.elements.size(); ++e) for_each_node(region, e, visit);
}

/// The ten nodes of a quadratic element: corners, then edges.
inline std::array<std::int32_t, 10> quadratic_nodes(const Region& region, std::size_t element) {
  std::array<std::int32_t, 10> nodes;
  std::copy(region.elements[element].begin(), region.elements[element].end(), nodes.begin());
  std::copy(region.edges[element].begin(), region.edges[element].end(), nodes.begin() + 4);
  return nodes;
}

}  // namespace tunica::distributed
