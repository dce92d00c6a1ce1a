// Scattering the rows and residuals of quadratic elements, of blood and wall alike; included only by the translation
// units of one instruction set each.
#pragma once

#include "tunica/assembly/batch_access.inl.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"

namespace tunica::coupling {

namespace {

/// One column of a block of the used lanes; where the batch is split, motion and pressure rows go their own ways.
template <int W>
TUNICA_INLINE void scatter_column(const assembly::BatchDouble4 (&column)[W], const std::int32_t* slots, int j,
                                  bool split, int used, float* blocks) {
  constexpr int pairs = fe::quadratic_nodes * fe::quadratic_nodes;
  const assembly::BatchFloat4 motion{1, 1, 1, 0}, pressure{0, 0, 0, 1};
  const int kind = split && j == 3 ? 1 : 0;  // columns 0-2 belong to the host, column 3 to the node
  for (int lane = 0; lane < used; ++lane) {
    const auto value = __builtin_convertvector(column[lane], assembly::BatchFloat4);
    const auto add = [&](int to, const assembly::BatchFloat4& part) {
      assembly::add_column(blocks + 16 * static_cast<std::ptrdiff_t>(slots[to * pairs * W + lane]) + 4 * j, part);
    };
    if (split) {
      add(kind, value * motion);
      add(kind + 2, value * pressure);
    } else {
      add(0, value);
    }
  }
}

/// Asks for the blocks of a row ahead of time, which saves a quarter of an assembly.
template <int W>
TUNICA_INLINE void prefetch_row(int a, const std::int32_t* slots, bool split, const float* blocks) {
  constexpr int n = fe::quadratic_nodes;
  for (int kind = 0; kind < (split ? 4 : 1); ++kind)
    for (int k = 0; k < n * W; ++k)
      __builtin_prefetch(blocks + 16 * static_cast<std::ptrdiff_t>(slots[(kind * n + a) * n * W + k]), 1);
}

/// What the node of a row feels of the element's unknowns: of the motion of all nodes, and of the pressures of the
/// corners; its constraint is a corner's. Null where there is none.
template <class T>
struct ScatteredRow {
  const Mat3<T>* motion;      ///< d momentum / d motion [10]
  const Vec3<T>* pressure;    ///< d momentum / d p [4]
  const Vec3<T>* constraint;  ///< d constraint / d motion [10]
  const T* constraint_by_p;   ///< d constraint / d p [4]
};

/// Adds row a of the element blocks; `slots` are those of the batch.
template <int W>
TUNICA_INLINE void scatter_row(const ScatteredRow<Pack<W>>& row, int a, const std::int32_t* slots, bool split, int used,
                               float* blocks) {
  const Pack<W> zero(0.0);
  for (int b = 0; b < fe::quadratic_nodes; ++b) {
    const std::int32_t* of_pair = slots + (fe::quadratic_nodes * a + b) * W;
    assembly::BatchDouble4 column[W];
    for (int j = 0; j < 3; ++j) {
      assembly::to_lanes<W>(row.motion[b](0, j), row.motion[b](1, j), row.motion[b](2, j),
                            row.constraint != nullptr ? row.constraint[b][j] : zero, column);
      scatter_column<W>(column, of_pair, j, split, used, blocks);
    }
    if (row.pressure == nullptr || b >= fe::nodes) continue;
    assembly::to_lanes<W>(row.pressure[b][0], row.pressure[b][1], row.pressure[b][2],
                          row.constraint_by_p != nullptr ? row.constraint_by_p[b] : zero, column);
    scatter_column<W>(column, of_pair, 3, split, used, blocks);
  }
}

/// r[node][4] += residuals of the used lanes. With `hosts` the momentum belongs to them.
template <int W>
TUNICA_INLINE void scatter_quadratic_residual(const Vec3<Pack<W>> (&momentum)[fe::quadratic_nodes],
                                              const Pack<W> (&constraint)[fe::nodes], const std::int32_t* nodes,
                                              const std::int32_t* hosts, int used, double* r) {
  const Pack<W> zero(0.0);
  for (int a = 0; a < fe::quadratic_nodes; ++a) {
    const auto& force = momentum[a];
    const Pack<W>& own = a < fe::nodes ? constraint[a] : zero;
    if (hosts == nullptr) {
      assembly::scatter_node<W>(force[0], force[1], force[2], own, nodes + a * W, used, r);
    } else {
      assembly::scatter_node<W>(force[0], force[1], force[2], zero, hosts + a * W, used, r);
      assembly::scatter_node<W>(zero, zero, zero, own, nodes + a * W, used, r);
    }
  }
}

}  // namespace

}  // namespace tunica::coupling
