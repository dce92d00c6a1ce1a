#include "tunica/assembly/element_batches.hpp"

#include <algorithm>

#include "tunica/distributed/element_nodes.hpp"

namespace tunica::assembly {

namespace {

// Only nodes on the interface have hosts, and an edge is twinned only where its corners are.
bool is_split(const distributed::DistributedMesh& mesh, const std::array<std::int32_t, 4>& element) {
  return std::any_of(element.begin(), element.end(), [&](std::int32_t node) { return mesh.host[node] != node; });
}

}  // namespace

std::vector<std::int32_t> elements_beside_hosts(const distributed::DistributedMesh& mesh,
                                                const distributed::Region& region, bool split) {
  std::vector<std::int32_t> result;
  for (std::size_t e = 0; e < region.elements.size(); ++e)
    if (is_split(mesh, region.elements[e]) == split) result.push_back(static_cast<std::int32_t>(e));
  return result;
}

ElementBatches make_batches(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                            const BlockPattern& pattern, int width, bool split) {
  return make_batches(mesh, region, elements_beside_hosts(mesh, region, split), pattern, width, split);
}

ElementBatches make_batches(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                            std::vector<std::int32_t> elements, const BlockPattern& pattern, int width, bool split) {
  ElementBatches result;
  result.width = width;
  result.split = split;
  result.elements_of_region = std::move(elements);
  result.elements = static_cast<std::int32_t>(result.elements_of_region.size());

  result.nodes_per_element = mesh.quadratic ? 10 : 4;
  const std::size_t batches = result.batches(), kinds = split ? 4 : 1, w = static_cast<std::size_t>(width);
  const auto count = static_cast<std::size_t>(result.nodes_per_element), pairs = count * count;
  result.nodes.resize(batches * count * w);
  if (split) result.hosts.resize(batches * count * w);
  result.slots.resize(batches * kinds * pairs * w);
  std::array<std::int32_t, 10> nodes{};
  for (std::size_t batch = 0; batch < batches; ++batch)
    for (std::size_t lane = 0; lane < w; ++lane) {
      const std::size_t position = std::min(batch * w + lane, static_cast<std::size_t>(result.elements) - 1);
      const auto e = static_cast<std::size_t>(result.elements_of_region[position]);
      std::size_t next = 0;
      distributed::for_each_node(region, e, [&](std::int32_t node) { nodes[next++] = node; });
      for (std::size_t a = 0; a < count; ++a) {
        result.nodes[(batch * count + a) * w + lane] = nodes[a];
        if (split) result.hosts[(batch * count + a) * w + lane] = mesh.host[nodes[a]];
        for (std::size_t b = 0; b < count; ++b)
          for (std::size_t kind = 0; kind < kinds; ++kind) {
            const bool motion_row = split && kind < 2, motion_column = split && kind % 2 == 0;
            const auto row = motion_row ? mesh.host[nodes[a]] : nodes[a];
            const auto column = motion_column ? mesh.host[nodes[b]] : nodes[b];
            result.slots[((batch * kinds + kind) * pairs + count * a + b) * w + lane] = pattern.slot(row, column);
          }
      }
    }
  return result;
}

}  // namespace tunica::assembly
