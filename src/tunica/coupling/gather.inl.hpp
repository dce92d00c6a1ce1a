// Gathering the nodal vectors of a batch; included only by the translation units of one instruction set each.
#pragma once

#include "tunica/assembly/batch_access.inl.hpp"
#include "tunica/coupling/loop_views.hpp"

namespace tunica::coupling {

namespace {

template <int W, int N>
TUNICA_INLINE void gather_vectors(const double* field, const std::int32_t* nodes, Vec3<Pack<W>> (&out)[N]) {
  for (int a = 0; a < N; ++a) {
    Pack<W> values[4];
    assembly::gather4<W>(field, nodes + a * W, values);
    for (int i = 0; i < 3; ++i) out[a][i] = values[i];
  }
}

/// The fourth entries of the first M nodes: pressures belong to corners.
template <int W, int N, int M>
TUNICA_INLINE void gather_vectors(const double* field, const std::int32_t* nodes, Vec3<Pack<W>> (&out)[N],
                                  Pack<W> (&fourth)[M]) {
  for (int a = 0; a < N; ++a) {
    Pack<W> values[4];
    assembly::gather4<W>(field, nodes + a * W, values);
    for (int i = 0; i < 3; ++i) out[a][i] = values[i];
    if (a < M) fourth[a] = values[3];
  }
}

template <int W>
TUNICA_INLINE int used_lanes(const BatchView& batches, std::int32_t batch) {
  const std::int32_t left = batches.elements - batch * W;
  return left < W ? left : W;
}

}  // namespace

}  // namespace tunica::coupling
