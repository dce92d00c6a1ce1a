// Stress and tangent at one deformation gradient: the whole of a law with its volumetric part, as an experimenter or a
// reference table sees it. The element kernels contract the same terms without forming them.
#pragma once

#include "tunica/wall/material_concept.hpp"
#include "tunica/wall/volumetric.hpp"

namespace tunica::wall {

/// Material tensors are in the axes of the law.
template <class T>
struct MaterialPoint {
  T J;                          ///< det F
  Symmetric<T> stress;          ///< second Piola-Kirchhoff S = 2 dPsi/dC [Pa]
  SymmetricTangent<T> tangent;  ///< CC = 2 dS/dC [Pa]
  Symmetric<T> cauchy;          ///< sigma = F S F^T / J [Pa]
};

namespace detail {

/// C^-1 (.) C^-1 of Holzapfel (2000), eq. 6.164, in the upper triangle.
template <class T>
TUNICA_INLINE T swapped(const Symmetric<T>& inverse, int m, int n) {
  const int i = voigt_row[m], j = voigt_column[m], k = voigt_row[n], l = voigt_column[n];
  const auto at = [&](int a, int b) { return inverse[voigt_index[a][b]]; };
  return T(0.5) * (at(i, k) * at(j, l) + at(i, l) * at(j, k));
}

/// Holzapfel (2000), eq. 6.166 to 6.168, from S_bar and CC_bar; p = dPsi_vol/dJ and slope = p + J dp/dJ.
template <class T>
TUNICA_INLINE void combine(const Symmetric<T>& C, const T& J, const Response<T>& bar, const T& p, const T& slope,
                           MaterialPoint<T>& point) {
  const T scale = pow(J, -2.0 / 3.0), inverse_J2 = T(1.0) / (J * J);
  const Symmetric<T> inverse{{inverse_J2 * (C[1] * C[2] - C[4] * C[4]), inverse_J2 * (C[0] * C[2] - C[5] * C[5]),
                              inverse_J2 * (C[0] * C[1] - C[3] * C[3]), inverse_J2 * (C[5] * C[4] - C[3] * C[2]),
                              inverse_J2 * (C[3] * C[5] - C[0] * C[4]), inverse_J2 * (C[3] * C[4] - C[1] * C[5])}};
  const T pull = scale * scale, work = scale * double_dot(bar.stress, C), third(1.0 / 3.0);
  Symmetric<T> isochoric = scale * bar.stress + (-third * work) * inverse;
  // C : CC' and its trace with C
  Symmetric<T> row;
#pragma GCC unroll 6
  for (int n = 0; n < voigt_size; ++n) {
    T sum(0.0);
#pragma GCC unroll 6
    for (int m = 0; m < voigt_size; ++m) sum += T(m < 3 ? 1.0 : 2.0) * C[m] * bar.tangent(m, n);
    row[n] = pull * sum;
  }
  const T both = T(1.0 / 9.0) * (double_dot(row, C) - T(2.0) * work) + J * slope;
  const T swap = T(2.0 / 3.0) * work - T(2.0) * J * p;
  // Everything of the form C^-1 (x) a + a (x) C^-1
  const Symmetric<T> cross = -third * row + T(-2.0 / 3.0) * isochoric;
#pragma GCC unroll 6
  for (int m = 0; m < voigt_size; ++m)
#pragma GCC unroll 6
    for (int n = m; n < voigt_size; ++n)
      point.tangent(m, n) = pull * bar.tangent(m, n) + inverse[m] * cross[n] + cross[m] * inverse[n] +
                            both * inverse[m] * inverse[n] + swap * swapped(inverse, m, n);
  point.stress = isochoric + (J * p) * inverse;
}

template <class T, class L>
TUNICA_INLINE MaterialPoint<T> material_point(const Mat3<T>& F, const L& law, const T& J, const T& p, const T& slope) {
  MaterialPoint<T> point;
  point.J = J;
  const Symmetric<T> C = right_cauchy_green(F), C_bar = pow(J, -2.0 / 3.0) * C;
  Response<T> bar;
  if constexpr (is_linear<L>) {
    bar.stress = stress(law, C_bar);
    for (T& x : bar.tangent.v) x = T(0.0);
  } else {
    bar = response(law, C_bar);
  }
  combine(C, J, bar, p, slope, point);
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) {
      const Response<T> unsplit = law.unsplit_response(C);
      point.stress = point.stress + unsplit.stress;
      for (int n = 0; n < 21; ++n) point.tangent.v[n] += unsplit.tangent.v[n];
    }
  const Mat3<T> tau = F * full(point.stress) * transpose(F);
  for (int n = 0; n < voigt_size; ++n) point.cauchy[n] = tau(voigt_row[n], voigt_column[n]) / J;
  return point;
}

}  // namespace detail

/// Strain energy per reference volume without its volumetric part [Pa]: Psi(C_bar) + Psi_u(C).
template <class T, class L>
TUNICA_INLINE T elastic_energy(const Mat3<T>& F, const L& law) {
  const Symmetric<T> C = right_cauchy_green(F);
  T psi = law.energy(pow(determinant(F), -2.0 / 3.0) * C);
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) psi += law.unsplit_energy(C);
  return psi;
}

/// With finite K. NaN for det F <= 0.
template <class T, class L>
TUNICA_INLINE MaterialPoint<T> material_point(const Mat3<T>& F, const L& law, const Volumetric& volumetric) {
  const T J = determinant(F), K(volumetric.bulk_modulus), p = K * volumetric.unit_pressure(J);
  return detail::material_point(F, law, J, p, T(p + J * K * volumetric.unit_stiffness(J)));
}

/// At a given pressure [Pa], positive in compression, that does not depend on F: an incompressible law whose pressure
/// balances a boundary condition.
template <class T, class L>
TUNICA_INLINE MaterialPoint<T> material_point_at_pressure(const Mat3<T>& F, const L& law, const T& pressure) {
  const T p = -pressure;
  return detail::material_point(F, law, determinant(F), p, p);
}

}  // namespace tunica::wall
