// Which rank owns which vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tunica/mesh/ordering.hpp"

namespace tunica::distributed {

/// Part 0 .. parts - 1 of each vertex by METIS k-way partitioning with a fixed seed: equal sums of `weights`, few edges
/// cut. Serial. Throws InputError if a part would stay empty, so that every rank has work.
std::vector<std::int32_t> partition(const mesh::Graph& graph, std::span<const std::int32_t> weights, int parts);

}  // namespace tunica::distributed
