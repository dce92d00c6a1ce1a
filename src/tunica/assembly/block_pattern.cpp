#include "tunica/assembly/block_pattern.hpp"

#include <algorithm>
#include <cassert>
#include <optional>

#include "tunica/distributed/element_nodes.hpp"

namespace tunica::assembly {

namespace {

struct Selection {
  std::optional<mesh::RegionKind> kind;  // none: all regions
  bool with_hosts = true;                // hosts of an element's nodes couple like nodes of the element
};

using CoupledNodes = std::array<std::int32_t, 20>;

// The distinct nodes of an element and of their hosts.
int coupled_nodes(const distributed::DistributedMesh& mesh, const distributed::Region& region, std::size_t e,
                  CoupledNodes& nodes) {
  int n = 0;
  distributed::for_each_node(region, e, [&](std::int32_t node) { nodes[n++] = node; });
  const int own = n;
  for (int a = 0; a < own; ++a)
    if (mesh.host[nodes[a]] != nodes[a]) nodes[n++] = mesh.host[nodes[a]];
  return n;
}

template <class Visit>
void for_each_pair(const distributed::DistributedMesh& mesh, const Selection& selection, Visit visit) {
  CoupledNodes nodes;
  for (const auto& region : mesh.regions) {
    if (selection.kind && region.kind != *selection.kind) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& corners = region.elements[e];
      const int n = selection.with_hosts ? coupled_nodes(mesh, region, e, nodes) : 4;
      if (!selection.with_hosts) std::copy(corners.begin(), corners.end(), nodes.begin());
      for (int a = 0; a < n; ++a)
        if (nodes[a] < mesh.owned_nodes)
          for (int b = 0; b < n; ++b) visit(nodes[a], nodes[b]);
    }
  }
  if (selection.with_hosts) return;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto host = mesh.host[i];
    if (host == i || i >= mesh.owned_nodes) continue;
    visit(i, host);
    visit(host, i);
  }
}

BlockPattern build(const distributed::DistributedMesh& mesh, const Selection& selection) {
  BlockPattern pattern;
  pattern.rows = mesh.owned_nodes;
  pattern.columns_count = mesh.nodes();
  // Count with repetitions, fill, then make each row unique in place.
  std::vector<std::size_t> begin(pattern.rows + 1, 0);
  for_each_pair(mesh, selection, [&](std::int32_t row, std::int32_t) { ++begin[row + 1]; });
  for (std::int32_t i = 0; i < pattern.rows; ++i) begin[i + 1] += begin[i] + 1;  // + 1: the diagonal is always there
  std::vector<std::int32_t> repeated(begin.back());
  std::vector<std::size_t> fill(begin.begin(), begin.end() - 1);
  for (std::int32_t i = 0; i < pattern.rows; ++i) repeated[fill[i]++] = i;
  for_each_pair(mesh, selection, [&](std::int32_t row, std::int32_t column) { repeated[fill[row]++] = column; });

  pattern.row_begin.assign(pattern.rows + 1, 0);
  pattern.diagonal.resize(pattern.rows);
  for (std::int32_t i = 0; i < pattern.rows; ++i) {
    const auto first = repeated.begin() + static_cast<std::ptrdiff_t>(begin[i]);
    const auto last = repeated.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
    std::sort(first, last);
    const auto end = std::unique(first, last);
    pattern.diagonal[i] = static_cast<std::int32_t>(pattern.columns.size() + (std::lower_bound(first, end, i) - first));
    pattern.columns.insert(pattern.columns.end(), first, end);
    pattern.row_begin[i + 1] = static_cast<std::int32_t>(pattern.columns.size());
  }
  return pattern;
}

}  // namespace

std::int32_t BlockPattern::slot(std::int32_t row, std::int32_t column) const {
  if (row >= rows) return blocks();
  const auto first = columns.begin() + row_begin[row], last = columns.begin() + row_begin[row + 1];
  const auto it = std::lower_bound(first, last, column);
  assert(it != last && *it == column);
  return static_cast<std::int32_t>(it - columns.begin());
}

BlockPattern make_pattern(const distributed::DistributedMesh& mesh) { return build(mesh, {}); }

BlockPattern make_pattern(const distributed::DistributedMesh& mesh, mesh::RegionKind kind) {
  return build(mesh, {kind, true});
}

BlockPattern make_pressure_pattern(const distributed::DistributedMesh& mesh) {
  return build(mesh, {std::nullopt, false});
}

}  // namespace tunica::assembly
