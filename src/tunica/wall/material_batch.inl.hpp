// Bodies of material_batch.hpp; included only by the translation units of one instruction set each.
#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "tunica/wall/material_batch.hpp"
#include "tunica/wall/material_point.hpp"

namespace tunica::wall {

namespace {

/// W gradients from `F`; the last one again for lanes beyond `count`.
template <int W>
TUNICA_INLINE Mat3<Pack<W>> load_gradients(const double* F, int count) {
  Mat3<Pack<W>> gradient;
  for (int lane = 0; lane < W; ++lane) {
    const double* from = F + 9 * std::min(lane, count - 1);
    for (int n = 0; n < 9; ++n) gradient(n / 3, n % 3).v[lane] = from[n];
  }
  return gradient;
}

template <int W>
TUNICA_INLINE Pack<W> load_pressures(const double* pressure, int count) {
  Pack<W> p;
  for (int lane = 0; lane < W; ++lane) p.v[lane] = pressure[std::min(lane, count - 1)];
  return p;
}

/// Into [lane][3][3].
template <int W>
TUNICA_INLINE void store_tensors(const Symmetric<Pack<W>>& tensor, int count, double* to) {
  double lanes_of[voigt_size][W];
  for (int k = 0; k < voigt_size; ++k) tensor[k].store(lanes_of[k]);
  for (int lane = 0; lane < count; ++lane)
    for (int n = 0; n < 9; ++n) to[9 * lane + n] = lanes_of[voigt_index[n / 3][n % 3]][lane];
}

/// Into [lane][6][6].
template <int W>
TUNICA_INLINE void store_tangents(const SymmetricTangent<Pack<W>>& tangent, int count, double* to) {
  double lanes_of[21][W];
  for (int k = 0; k < 21; ++k) tangent.v[k].store(lanes_of[k]);
  for (int lane = 0; lane < count; ++lane)
#pragma GCC unroll 6
    for (int i = 0; i < voigt_size; ++i)
#pragma GCC unroll 6
      for (int j = 0; j < voigt_size; ++j)
        to[36 * lane + 6 * i + j] = lanes_of[SymmetricTangent<double>::index(i, j)][lane];
}

template <int W, class L>
TUNICA_INLINE void store_energies(const Mat3<Pack<W>>& F, const L& law, const Volumetric& volumetric, int count,
                                  double* to) {
  Pack<W> psi = elastic_energy(F, law);
  if (std::isfinite(volumetric.bulk_modulus))
    psi += Pack<W>(volumetric.bulk_modulus) * volumetric.unit_energy(determinant(F));
  for (int lane = 0; lane < count; ++lane) to[lane] = psi.v[lane];
}

/// The first `count` lanes of a pack of points, from the point `first` on.
template <int W, class L>
TUNICA_INLINE void evaluate_pack(const L& law, const Volumetric& volumetric, const double* F, const double* pressure,
                                 std::size_t first, int count, const MaterialBatchResults& results) {
  using P = Pack<W>;
  const Mat3<P> gradient = load_gradients<W>(F + 9 * first, count);
  if (results.energy != nullptr) store_energies<W>(gradient, law, volumetric, count, results.energy + first);
  if (results.stress == nullptr && results.cauchy == nullptr && results.tangent == nullptr) return;
  // dPsi_vol/dJ and what its slope adds to the tangent, as material_point() and material_point_at_pressure()
  const P J = determinant(gradient);
  P p, slope;
  if (pressure == nullptr) {
    const P K(volumetric.bulk_modulus);
    p = K * volumetric.unit_pressure(J);
    slope = p + J * K * volumetric.unit_stiffness(J);
  } else {
    p = slope = -load_pressures<W>(pressure + first, count);
  }
  const MaterialPoint<P> point = detail::material_point(gradient, law, J, p, slope);
  if (results.stress != nullptr) store_tensors<W>(point.stress, count, results.stress + 9 * first);
  if (results.cauchy != nullptr) store_tensors<W>(point.cauchy, count, results.cauchy + 9 * first);
  if (results.tangent != nullptr) store_tangents<W>(point.tangent, count, results.tangent + 36 * first);
}

template <int W, class L>
__attribute__((noinline)) void evaluate_law(const L& law, const Volumetric& volumetric, const double* F,
                                            const double* pressure, std::size_t points,
                                            const MaterialBatchResults& results) {
  for (std::size_t first = 0; first < points; first += W)
    evaluate_pack<W>(law, volumetric, F, pressure, first, static_cast<int>(std::min<std::size_t>(W, points - first)),
                     results);
}

template <int W>
void evaluate_batch(const Law& law, const Volumetric& volumetric, const double* F, const double* pressure,
                    std::size_t points, const MaterialBatchResults& results) {
  std::visit([&](const auto& l) { evaluate_law<W>(l, volumetric, F, pressure, points, results); }, law);
}

}  // namespace

template <int W>
MaterialBatch material_batch() {
  return &evaluate_batch<W>;
}

}  // namespace tunica::wall
