// Elements of the lumen in groups for the element loops: those along the wall, whose nodes move with the unknown, and
// the rest.
#pragma once

#include <span>
#include <vector>

#include "tunica/assembly/element_batches.hpp"
#include "tunica/coupling/loop_views.hpp"

namespace tunica::coupling {

struct LumenGroup {
  assembly::ElementBatches batches;
  std::vector<double> moves;  ///< as in LumenGroupView; empty for none

  LumenGroupView view() const { return {BatchView(batches), moves.empty() ? nullptr : moves.data()}; }
};

/// Groups of a lumen region. `follows_wall`: 1 for nodes that move with the wall [local node].
std::vector<LumenGroup> lumen_groups(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                                     std::span<const char> follows_wall, const assembly::BlockPattern& pattern,
                                     int width);

}  // namespace tunica::coupling
