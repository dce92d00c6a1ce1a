// Graph of what is coupled with what, and an order of its vertices that keeps neighbours close.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tunica::mesh {

/// Adjacency in compressed rows: neighbours of v are neighbours[begin[v]] .. neighbours[begin[v + 1] - 1], without v
/// itself and without repetition.
struct Graph {
  std::vector<std::int64_t> begin;
  std::vector<std::int32_t> neighbours;

  std::int32_t size() const { return static_cast<std::int32_t>(begin.size()) - 1; }
  std::span<const std::int32_t> of(std::int32_t v) const {
    return std::span(neighbours)
        .subspan(static_cast<std::size_t>(begin[v]), static_cast<std::size_t>(begin[v + 1] - begin[v]));
  }
};

/// Vertices 0 .. vertices - 1, adjacent when an element holds both. N = 4 and 10 are there.
template <std::size_t N>
Graph graph_of_elements(std::int32_t vertices, const std::vector<std::array<std::int32_t, N>>& elements);

/// All vertices ordered by part, and inside each part by reverse Cuthill-McKee (George and Liu 1981, ch. 4) on the
/// edges inside the part, each connected piece from a vertex at its far end. `part` of each vertex: 0 .. parts - 1.
/// Deterministic: ties go to the lower vertex.
std::vector<std::int32_t> reverse_cuthill_mckee(const Graph& graph, std::span<const std::int32_t> part, int parts);

}  // namespace tunica::mesh
