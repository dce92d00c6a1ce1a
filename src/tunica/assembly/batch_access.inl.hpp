// Gathering nodal values into packs and scattering element matrices into slots: the inner part of every element loop.
// Included only by the translation units of one instruction set each; everything is inlined there.
#pragma once

#include <cstdint>

#include "tunica/base/pack.hpp"
#include "tunica/fe/tetrahedron.hpp"

namespace tunica::assembly {

namespace {

typedef double BatchDouble4 __attribute__((vector_size(32)));
typedef float BatchFloat4 __attribute__((vector_size(16)));

// Transposes a 4 x 4 square of doubles held in four registers.
TUNICA_INLINE void transpose4(BatchDouble4& a, BatchDouble4& b, BatchDouble4& c, BatchDouble4& d) {
  typedef std::int64_t I __attribute__((vector_size(32)));
  const BatchDouble4 t0 = __builtin_shuffle(a, b, I{0, 4, 2, 6}), t1 = __builtin_shuffle(a, b, I{1, 5, 3, 7});
  const BatchDouble4 t2 = __builtin_shuffle(c, d, I{0, 4, 2, 6}), t3 = __builtin_shuffle(c, d, I{1, 5, 3, 7});
  a = __builtin_shuffle(t0, t2, I{0, 1, 4, 5});
  b = __builtin_shuffle(t1, t3, I{0, 1, 4, 5});
  c = __builtin_shuffle(t0, t2, I{2, 3, 6, 7});
  d = __builtin_shuffle(t1, t3, I{2, 3, 6, 7});
}

// Four lanes of a pack, and a pack from groups of four. Register moves only: going through memory with another access
// width would stall on store forwarding.
template <int group>
TUNICA_INLINE BatchDouble4 quarter(const Pack<4>& p) {
  static_assert(group == 0);
  return p.v;
}
template <int group>
TUNICA_INLINE BatchDouble4 quarter(const Pack<8>& p) {
  return __builtin_shufflevector(p.v, p.v, 4 * group, 4 * group + 1, 4 * group + 2, 4 * group + 3);
}
TUNICA_INLINE Pack<4> join(BatchDouble4 low) { return Pack<4>(low); }
TUNICA_INLINE Pack<8> join(BatchDouble4 low, BatchDouble4 high) {
  return Pack<8>(__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7));
}

TUNICA_INLINE void load_transposed(const double* field, const std::int32_t* nodes, BatchDouble4 (&r)[4]) {
  for (int lane = 0; lane < 4; ++lane)
    __builtin_memcpy(&r[lane], field + 4 * static_cast<std::ptrdiff_t>(nodes[lane]), sizeof r[lane]);
  transpose4(r[0], r[1], r[2], r[3]);
}

/// Values of one node index per lane from a field of stride 4.
template <int W>
TUNICA_INLINE void gather4(const double* field, const std::int32_t* nodes, Pack<W> (&out)[4]) {
  if constexpr (W == 8) {
    BatchDouble4 low[4], high[4];
    load_transposed(field, nodes, low);
    load_transposed(field, nodes + 4, high);
    for (int c = 0; c < 4; ++c) out[c] = join(low[c], high[c]);
  } else if constexpr (W == 4) {
    BatchDouble4 r[4];
    load_transposed(field, nodes, r);
    for (int c = 0; c < 4; ++c) out[c] = join(r[c]);
  } else {
    double values[4][W];
    for (int lane = 0; lane < W; ++lane)
      for (int c = 0; c < 4; ++c) values[c][lane] = field[4 * static_cast<std::ptrdiff_t>(nodes[lane]) + c];
    for (int c = 0; c < 4; ++c) out[c] = Pack<W>::load(values[c]);
  }
}

template <int group, int W>
TUNICA_INLINE void group_to_lanes(const Pack<W>& p0, const Pack<W>& p1, const Pack<W>& p2, const Pack<W>& p3,
                                  BatchDouble4 (&out)[W]) {
  out[4 * group] = quarter<group>(p0);
  out[4 * group + 1] = quarter<group>(p1);
  out[4 * group + 2] = quarter<group>(p2);
  out[4 * group + 3] = quarter<group>(p3);
  transpose4(out[4 * group], out[4 * group + 1], out[4 * group + 2], out[4 * group + 3]);
}

/// Four packs (one per component) to one contiguous group of four doubles per lane.
template <int W>
TUNICA_INLINE void to_lanes(const Pack<W>& p0, const Pack<W>& p1, const Pack<W>& p2, const Pack<W>& p3,
                            BatchDouble4 (&out)[W]) {
  if constexpr (W == 2) {
    for (int lane = 0; lane < W; ++lane) out[lane] = BatchDouble4{p0.v[lane], p1.v[lane], p2.v[lane], p3.v[lane]};
  } else {
    group_to_lanes<0>(p0, p1, p2, p3, out);
    if constexpr (W == 8) group_to_lanes<1>(p0, p1, p2, p3, out);
  }
}

/// r[node][4] += four packs of the used lanes, for one node of each element.
template <int W>
TUNICA_INLINE void scatter_node(const Pack<W>& p0, const Pack<W>& p1, const Pack<W>& p2, const Pack<W>& p3,
                                const std::int32_t* nodes, int used, double* r) {
  BatchDouble4 value[W];
  to_lanes<W>(p0, p1, p2, p3, value);
#pragma GCC unroll 8
  for (int lane = 0; lane < W; ++lane) {
    if (lane >= used) break;
    double* target = r + 4 * static_cast<std::ptrdiff_t>(nodes[lane]);
    BatchDouble4 sum;
    __builtin_memcpy(&sum, target, sizeof sum);
    sum += value[lane];
    __builtin_memcpy(target, &sum, sizeof sum);
  }
}

/// r[node][4] += element residuals of the used lanes.
template <int W>
TUNICA_INLINE void scatter_residual(const fe::ElementVector<Pack<W>>& e, const std::int32_t* nodes, int used,
                                    double* r) {
  for (int a = 0; a < 4; ++a) scatter_node<W>(e.r[a][0], e.r[a][1], e.r[a][2], e.r[a][3], nodes + a * W, used, r);
}

/// The same where the motion belongs to the host and the pressure to the node itself.
template <int W>
TUNICA_INLINE void scatter_residual_split(const fe::ElementVector<Pack<W>>& e, const std::int32_t* nodes,
                                          const std::int32_t* hosts, int used, double* r) {
  for (int a = 0; a < 4; ++a)
    for (int lane = 0; lane < used; ++lane) {
      double* host = r + 4 * static_cast<std::ptrdiff_t>(hosts[a * W + lane]);
      for (int c = 0; c < 3; ++c) host[c] += e.r[a][c].v[lane];
      r[4 * static_cast<std::ptrdiff_t>(nodes[a * W + lane]) + 3] += e.r[a][3].v[lane];
    }
}

/// Asks for the blocks of a batch ahead of time: they lie all over a matrix that is larger than the caches.
template <int W>
TUNICA_INLINE void prefetch_blocks(const std::int32_t* slots, int kinds, const float* blocks) {
  for (int k = 0; k < kinds * 16 * W; ++k) __builtin_prefetch(blocks + 16 * static_cast<std::ptrdiff_t>(slots[k]), 1);
}

TUNICA_INLINE void add_column(float* target, BatchFloat4 value) {
  BatchFloat4 sum;
  __builtin_memcpy(&sum, target, sizeof sum);
  sum += value;
  __builtin_memcpy(target, &sum, sizeof sum);
}

/// blocks[slot] += element blocks of the used lanes; blocks are 4 x 4 floats, column by column.
template <int W>
TUNICA_INLINE void scatter_tangent(const fe::ElementMatrix<Pack<W>>& e, const std::int32_t* slots, int used,
                                   float* blocks) {
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int j = 0; j < 4; ++j) {
        BatchDouble4 column[W];
        to_lanes<W>(e.k[a][b][0][j], e.k[a][b][1][j], e.k[a][b][2][j], e.k[a][b][3][j], column);
#pragma GCC unroll 8
        for (int lane = 0; lane < W; ++lane) {
          if (lane >= used) break;
          add_column(blocks + 16 * static_cast<std::ptrdiff_t>(slots[(4 * a + b) * W + lane]) + 4 * j,
                     __builtin_convertvector(column[lane], BatchFloat4));
        }
      }
}

/// The same with each block spread over its four slots (ElementBatches::split).
template <int W>
TUNICA_INLINE void scatter_tangent_split(const fe::ElementMatrix<Pack<W>>& e, const std::int32_t* slots, int used,
                                         float* blocks) {
  const auto target = [&](int kind, int pair, int lane) {
    return blocks + 16 * static_cast<std::ptrdiff_t>(slots[(kind * 16 + pair) * W + lane]);
  };
  const BatchFloat4 motion{1, 1, 1, 0}, pressure{0, 0, 0, 1};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int j = 0; j < 4; ++j) {
        BatchDouble4 column[W];
        to_lanes<W>(e.k[a][b][0][j], e.k[a][b][1][j], e.k[a][b][2][j], e.k[a][b][3][j], column);
        const int kind = j < 3 ? 0 : 1;  // columns 0-2 belong to the host, column 3 to the node
#pragma GCC unroll 8
        for (int lane = 0; lane < W; ++lane) {
          if (lane >= used) break;
          const BatchFloat4 value = __builtin_convertvector(column[lane], BatchFloat4);
          add_column(target(kind, 4 * a + b, lane) + 4 * j, value * motion);
          add_column(target(kind + 2, 4 * a + b, lane) + 4 * j, value * pressure);
        }
      }
}

}  // namespace

}  // namespace tunica::assembly
