#include "tunica/mesh/ordering.hpp"

#include <algorithm>
#include <numeric>

namespace tunica::mesh {

namespace {

/// Elements of each vertex, in compressed rows.
template <std::size_t N>
Graph elements_of_vertices(std::int32_t vertices, const std::vector<std::array<std::int32_t, N>>& elements) {
  Graph rows;
  rows.begin.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& element : elements)
    for (const std::int32_t v : element) ++rows.begin[v + 1];
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  rows.neighbours.resize(static_cast<std::size_t>(rows.begin.back()));
  std::vector<std::int64_t> next(rows.begin.begin(), rows.begin.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const std::int32_t v : elements[e]) rows.neighbours[next[v]++] = static_cast<std::int32_t>(e);
  return rows;
}

class CuthillMcKee {
 public:
  CuthillMcKee(const Graph& graph, std::span<const std::int32_t> part)
      : graph_(graph), part_(part), numbered_(part.size(), 0), seen_(part.size(), 0) {
    order_.reserve(part.size());
  }

  /// Numbers the connected piece of `vertex` inside its part, unless that is done already.
  void number_piece(std::int32_t vertex) {
    if (numbered_[vertex]) return;
    std::size_t next = order_.size();
    append(far_end(vertex));
    for (; next < order_.size(); ++next) {
      const std::int32_t v = order_[next];
      const std::size_t first_new = order_.size();
      for (const std::int32_t w : graph_.of(v))
        if (part_[w] == part_[v] && !numbered_[w]) append(w);
      std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first_new), order_.end(),
                [&](std::int32_t a, std::int32_t b) { return lighter(a, b); });
    }
  }

  std::vector<std::int32_t>& order() { return order_; }

 private:
  void append(std::int32_t vertex) {
    numbered_[vertex] = 1;
    order_.push_back(vertex);
  }

  bool lighter(std::int32_t a, std::int32_t b) const {
    const auto da = graph_.of(a).size(), db = graph_.of(b).size();
    return da != db ? da < db : a < b;
  }

  /// A vertex of nearly largest eccentricity: repeated breadth-first searches from the lightest vertex found last.
  std::int32_t far_end(std::int32_t start) {
    int depth = search(start);
    for (;;) {
      const std::int32_t candidate =
          *std::min_element(queue_.begin() + static_cast<std::ptrdiff_t>(last_level_), queue_.end(),
                            [&](std::int32_t a, std::int32_t b) { return lighter(a, b); });
      const int deeper = search(candidate);
      if (deeper <= depth) return start;
      start = candidate;
      depth = deeper;
    }
  }

  /// Breadth-first search; fills `queue_`, whose last level begins at `last_level_`, and returns the number of levels.
  int search(std::int32_t start) {
    ++stamp_;
    queue_.assign(1, start);
    seen_[start] = stamp_;
    int levels = 0;
    for (std::size_t level = 0; level < queue_.size(); ++levels) {
      const std::size_t level_end = queue_.size();
      last_level_ = level;
      for (; level < level_end; ++level)
        for (const std::int32_t w : graph_.of(queue_[level]))
          if (part_[w] == part_[start] && seen_[w] != stamp_) {
            seen_[w] = stamp_;
            queue_.push_back(w);
          }
    }
    return levels;
  }

  const Graph& graph_;
  std::span<const std::int32_t> part_;
  std::vector<char> numbered_;
  std::vector<std::int32_t> seen_, queue_, order_;
  std::int32_t stamp_ = 0;
  std::size_t last_level_ = 0;
};

}  // namespace

template <std::size_t N>
Graph graph_of_elements(std::int32_t vertices, const std::vector<std::array<std::int32_t, N>>& elements) {
  const Graph incident = elements_of_vertices(vertices, elements);
  Graph graph;
  graph.begin.reserve(static_cast<std::size_t>(vertices) + 1);
  graph.begin.push_back(0);
  graph.neighbours.reserve(static_cast<std::size_t>(vertices) * 16);  // a tetrahedral mesh has about 14 per node
  std::vector<std::int32_t> seen_from(static_cast<std::size_t>(vertices), -1);
  for (std::int32_t v = 0; v < vertices; ++v) {
    seen_from[v] = v;
    for (const std::int32_t e : incident.of(v))
      for (const std::int32_t w : elements[e])
        if (seen_from[w] != v) {
          seen_from[w] = v;
          graph.neighbours.push_back(w);
        }
    graph.begin.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

template Graph graph_of_elements(std::int32_t, const std::vector<std::array<std::int32_t, 4>>&);
template Graph graph_of_elements(std::int32_t, const std::vector<std::array<std::int32_t, 10>>&);

std::vector<std::int32_t> reverse_cuthill_mckee(const Graph& graph, std::span<const std::int32_t> part, int parts) {
  std::vector<std::int32_t> by_part(part.size());
  std::iota(by_part.begin(), by_part.end(), 0);
  std::stable_sort(by_part.begin(), by_part.end(), [&](std::int32_t a, std::int32_t b) { return part[a] < part[b]; });

  CuthillMcKee numbering(graph, part);
  for (const std::int32_t v : by_part) numbering.number_piece(v);

  auto& order = numbering.order();
  auto begin = order.begin();
  for (int p = 0; p < parts; ++p) {
    const auto end = std::partition_point(begin, order.end(), [&](std::int32_t v) { return part[v] <= p; });
    std::reverse(begin, end);
    begin = end;
  }
  return std::move(order);
}

}  // namespace tunica::mesh
