// Values of wall elements from those of their neighbours.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "tunica/frames/element_graph.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

inline Vec3<double> vector_at(const std::vector<double>& vectors, std::int32_t e) {
  const double* v = vectors.data() + 3 * static_cast<std::size_t>(e);
  return {{v[0], v[1], v[2]}};
}

inline bool is_set(const std::vector<double>& values, int components, std::int32_t e) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(e) * components;
  return std::any_of(first, first + components, [](double x) { return x != 0; });
}

/// Gives elements without a value (all components 0) the mean of their neighbours that have one, layer by layer:
/// `mean(values, neighbours, result)`. Returns how many elements of all ranks no path leads to. Collective.
template <class Mean>
std::int64_t carry_inwards(const ElementGraph& graph, std::vector<double>& values, int components, const Mean& mean) {
  const auto comm = graph.mesh().comm;
  std::vector<std::int32_t> missing;
  for (std::int32_t e = 0; e < graph.owned(); ++e)
    if (!is_set(values, components, e)) missing.push_back(e);
  auto left = parallel::global_sum(comm, static_cast<std::int64_t>(missing.size()));
  std::vector<std::int32_t> known;
  while (left > 0) {
    auto next = values;
    std::erase_if(missing, [&](std::int32_t e) {
      known.clear();
      for (const auto n : graph.neighbours(e))
        if (is_set(values, components, n)) known.push_back(n);
      if (!known.empty()) mean(values, known, next.data() + static_cast<std::size_t>(e) * components);
      return !known.empty();
    });
    values = std::move(next);
    graph.update(values, components);
    const auto now = parallel::global_sum(comm, static_cast<std::int64_t>(missing.size()));
    if (now == left) break;
    left = now;
  }
  return left;
}

/// One cycle over all owned elements: `mean(values, {element, its neighbours...}, result)`. Collective.
template <class Mean>
void average(const ElementGraph& graph, std::vector<double>& values, int components, const Mean& mean) {
  auto next = values;
  std::vector<std::int32_t> elements;
  for (std::int32_t e = 0; e < graph.owned(); ++e) {
    elements.assign(1, e);
    elements.insert(elements.end(), graph.neighbours(e).begin(), graph.neighbours(e).end());
    mean(values, elements, next.data() + static_cast<std::size_t>(e) * components);
  }
  values = std::move(next);
  graph.update(values, components);
}

/// Of symmetric tensors, [element][6].
inline void mean_dyad(const std::vector<double>& values, std::span<const std::int32_t> elements, double* result) {
  std::fill(result, result + 6, 0.0);
  for (const auto e : elements)
    for (int i = 0; i < 6; ++i) result[i] += values[6 * static_cast<std::size_t>(e) + i];
  for (int i = 0; i < 6; ++i) result[i] /= static_cast<double>(elements.size());
}

}  // namespace tunica::frames
