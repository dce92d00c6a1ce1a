#include "tunica/coupling/lumen_groups.hpp"

#include <algorithm>

namespace tunica::coupling {

std::vector<LumenGroup> lumen_groups(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                                     std::span<const char> follows_wall, const assembly::BlockPattern& pattern,
                                     int width) {
  std::vector<std::int32_t> beside, inner;
  for (std::size_t e = 0; e < region.elements.size(); ++e) {
    const auto& nodes = region.elements[e];
    const bool moves = std::any_of(nodes.begin(), nodes.end(), [&](auto node) { return follows_wall[node] != 0; });
    (moves ? beside : inner).push_back(static_cast<std::int32_t>(e));
  }
  std::vector<LumenGroup> groups;
  if (!inner.empty()) groups.push_back({make_batches(mesh, region, std::move(inner), pattern, width, false), {}});
  if (beside.empty()) return groups;
  LumenGroup& group = groups.emplace_back();
  group.batches = make_batches(mesh, region, std::move(beside), pattern, width, false);
  for (const auto node : group.batches.nodes) group.moves.push_back(follows_wall[node] != 0 ? 1.0 : 0.0);
  return groups;
}

}  // namespace tunica::coupling
