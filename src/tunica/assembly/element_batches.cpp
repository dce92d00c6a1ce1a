#include "tunica/assembly/element_batches.hpp"

#include <algorithm>

namespace tunica::assembly {

namespace {

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

  const std::size_t batches = result.batches(), kinds = split ? 4 : 1, w = static_cast<std::size_t>(width);
  result.nodes.resize(batches * 4 * w);
  if (split) result.hosts.resize(batches * 4 * w);
  result.slots.resize(batches * kinds * 16 * w);
  for (std::size_t batch = 0; batch < batches; ++batch)
    for (std::size_t lane = 0; lane < w; ++lane) {
      const std::size_t e = std::min(batch * w + lane, static_cast<std::size_t>(result.elements) - 1);
      const auto& element = region.elements[result.elements_of_region[e]];
      for (std::size_t a = 0; a < 4; ++a) {
        result.nodes[(batch * 4 + a) * w + lane] = element[a];
        if (split) result.hosts[(batch * 4 + a) * w + lane] = mesh.host[element[a]];
        for (std::size_t b = 0; b < 4; ++b)
          for (std::size_t kind = 0; kind < kinds; ++kind) {
            const bool motion_row = split && kind < 2, motion_column = split && kind % 2 == 0;
            const auto row = motion_row ? mesh.host[element[a]] : element[a];
            const auto column = motion_column ? mesh.host[element[b]] : element[b];
            result.slots[((batch * kinds + kind) * 16 + 4 * a + b) * w + lane] = pattern.slot(row, column);
          }
      }
    }
  return result;
}

}  // namespace tunica::assembly
