// Elements in groups of as many as a pack has lanes, with everything a loop over them needs laid out in its order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/assembly/block_pattern.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::assembly {

/// Batches of tetrahedra. The last batch repeats an element in its spare lanes; `lanes_used` tells how many count.
///
/// Where no node of an element has a host of its own (all of the lumen, most of the wall), one slot per node pair takes
/// the 4 x 4 block. Elements of the wall along the lumen are `split`: the motion belongs to the host's row and column,
/// the pressure to the node's own, so a block is spread over four slots (motion-motion, motion-pressure,
/// pressure-motion, pressure-pressure).
struct ElementBatches {
  int width = 1;
  bool split = false;
  int nodes_per_element = 4;  ///< 4, or 10 with those on its edges
  std::int32_t elements = 0;
  std::vector<std::int32_t> nodes;               ///< [batch][nodes of an element][width]
  std::vector<std::int32_t> hosts;               ///< [batch][nodes of an element][width], split only
  std::vector<std::int32_t> slots;               ///< [batch][1 or 4][pair of nodes][width]
  std::vector<std::int32_t> elements_of_region;  ///< [element]: its position in Region::elements

  std::int32_t batches() const { return (elements + width - 1) / width; }
  int lanes_used(std::int32_t batch) const {
    const std::int32_t left = elements - batch * width;
    return left < width ? left : width;
  }
};

/// Positions in Region::elements of those that are (`split`) or are not next to a host, in the order of the region.
std::vector<std::int32_t> elements_beside_hosts(const distributed::DistributedMesh& mesh,
                                                const distributed::Region& region, bool split);

/// Batches of some elements of `region`, all of which are (`split`) or are not next to a host.
ElementBatches make_batches(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                            std::vector<std::int32_t> elements, const BlockPattern& pattern, int width, bool split);

/// Batches of all elements of `region` that are (`split`) or are not next to a host.
ElementBatches make_batches(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                            const BlockPattern& pattern, int width, bool split);

}  // namespace tunica::assembly
