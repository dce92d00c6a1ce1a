// Access to nodal fields, [local node][4].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tunica/base/tensor.hpp"

namespace tunica::coupling {

/// Position of a node's first entry.
inline std::size_t at(std::int32_t node) { return 4 * static_cast<std::size_t>(node); }

inline Vec3<double> vector_at(const double* field, std::int32_t node) {
  const double* v = field + at(node);
  return {{v[0], v[1], v[2]}};
}

/// Vectors at the nodes of a triangle or tetrahedron.
template <std::size_t N>
void gather(const double* field, const std::array<std::int32_t, N>& nodes, Vec3<double> (&out)[N]) {
  for (std::size_t a = 0; a < N; ++a) out[a] = vector_at(field, nodes[a]);
}

}  // namespace tunica::coupling
