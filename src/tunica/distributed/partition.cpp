#include "tunica/distributed/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <limits>

#include "tunica/base/error.hpp"

namespace tunica::distributed {

namespace {

void check_size(const mesh::Graph& graph, int parts) {
  if (graph.size() < parts)
    throw InputError("mesh", fmt::format("{} nodes cannot be spread over {} ranks", graph.size(), parts),
                     fmt::format("run on at most {} ranks", graph.size()));
  if (graph.neighbours.size() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()))
    throw InputError("mesh",
                     fmt::format("{} couplings between nodes, METIS was built for at most {}", graph.neighbours.size(),
                                 std::numeric_limits<idx_t>::max()),
                     "install a METIS with 64-bit integers or use a coarser mesh");
}

void check_none_empty(const std::vector<std::int32_t>& part, int parts) {
  std::vector<char> used(static_cast<std::size_t>(parts), 0);
  for (const std::int32_t p : part) used[p] = 1;
  const auto empty = std::count(used.begin(), used.end(), 0);
  if (empty > 0)
    throw InputError("mesh", fmt::format("{} of {} ranks would own none of the {} nodes", empty, parts, part.size()),
                     "run on fewer ranks");
}

}  // namespace

std::vector<std::int32_t> partition(const mesh::Graph& graph, std::span<const std::int32_t> weights, int parts) {
  check_size(graph, parts);
  if (parts == 1) return std::vector<std::int32_t>(static_cast<std::size_t>(graph.size()), 0);

  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  idx_t vertices = graph.size(), constraints = 1, part_count = parts, cut = 0;
  std::vector<idx_t> begin(graph.begin.begin(), graph.begin.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> vertex_weights(weights.begin(), weights.end());
  std::vector<idx_t> part(static_cast<std::size_t>(vertices));
  const int status =
      METIS_PartGraphKway(&vertices, &constraints, begin.data(), neighbours.data(), vertex_weights.data(), nullptr,
                          nullptr, &part_count, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw SolverError(fmt::format("METIS failed to partition the mesh (code {})", status));
  std::vector<std::int32_t> result(part.begin(), part.end());
  check_none_empty(result, parts);
  return result;
}

}  // namespace tunica::distributed
