// Symmetric second-order tensors and symmetric tangents in Voigt storage, order 11 22 33 12 23 13.
//
// Entries are tensor components: no factor 2 on shear. Where a contraction counts both off-diagonal entries, the
// function says so.
#pragma once

#include "tunica/base/tensor.hpp"

namespace tunica::wall {

inline constexpr int voigt_size = 6;
inline constexpr int voigt_row[voigt_size] = {0, 1, 2, 0, 1, 0};
inline constexpr int voigt_column[voigt_size] = {0, 1, 2, 1, 2, 2};
inline constexpr int voigt_index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

template <class T>
struct Symmetric {
  T v[voigt_size];
  TUNICA_INLINE T& operator[](int i) { return v[i]; }
  TUNICA_INLINE const T& operator[](int i) const { return v[i]; }
};

/// Fourth-order tensor with both minor and the major symmetry: upper triangle of its 6 x 6 Voigt matrix.
template <class T>
struct SymmetricTangent {
  T v[21];
  static constexpr int index(int i, int j) { return i <= j ? i * (11 - i) / 2 + j : j * (11 - j) / 2 + i; }
  TUNICA_INLINE T& operator()(int i, int j) { return v[index(i, j)]; }
  TUNICA_INLINE const T& operator()(int i, int j) const { return v[index(i, j)]; }
};

template <class T>
TUNICA_INLINE T trace(const Symmetric<T>& a) {
  return a[0] + a[1] + a[2];
}
/// a : b, off-diagonal entries counted twice.
template <class T>
TUNICA_INLINE T double_dot(const Symmetric<T>& a, const Symmetric<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + T(2.0) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
/// sqrt(a : a).
template <class T>
TUNICA_INLINE T norm(const Symmetric<T>& a) {
  return sqrt(double_dot(a, a));
}
template <class T>
TUNICA_INLINE Symmetric<T> operator+(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]}};
}
template <class T>
TUNICA_INLINE Symmetric<T> operator*(const T& s, const Symmetric<T>& a) {
  return {{s * a[0], s * a[1], s * a[2], s * a[3], s * a[4], s * a[5]}};
}
template <class T>
TUNICA_INLINE Vec3<T> operator*(const Symmetric<T>& a, const Vec3<T>& x) {
  return {{a[0] * x[0] + a[3] * x[1] + a[5] * x[2], a[3] * x[0] + a[1] * x[1] + a[4] * x[2],
           a[5] * x[0] + a[4] * x[1] + a[2] * x[2]}};
}
template <class T>
TUNICA_INLINE T determinant(const Symmetric<T>& a) {
  return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) + a[5] * (a[3] * a[4] - a[1] * a[5]);
}
/// Right Cauchy-Green tensor C = F^T F.
template <class T>
TUNICA_INLINE Symmetric<T> right_cauchy_green(const Mat3<T>& F) {
  Symmetric<T> C;
#pragma GCC unroll 6
  for (int n = 0; n < voigt_size; ++n) {
    const int i = voigt_row[n], j = voigt_column[n];
    C[n] = F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
  }
  return C;
}
template <class T>
TUNICA_INLINE Mat3<T> full(const Symmetric<T>& a) {
  return {{{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}}};
}

/// |F F A F F|^2 of a material tangent A pushed forward, from C = F^T F: A_IJKL A_MNPQ C_IM C_JN C_KP C_LQ.
template <class T>
TUNICA_INLINE T squared_norm(const SymmetricTangent<T>& A, const Symmetric<T>& C) {
  T pull[voigt_size][voigt_size];  // C_PM C_QN, symmetric in PQ, rows and columns counted as often as they occur
#pragma GCC unroll 6
  for (int k = 0; k < voigt_size; ++k)
#pragma GCC unroll 6
    for (int n = 0; n < voigt_size; ++n) {
      const int p = voigt_row[k], q = voigt_column[k], i = voigt_row[n], j = voigt_column[n];
      const auto at = [&](int a, int b) { return C[voigt_index[a][b]]; };
      pull[k][n] = T((k < 3 ? 0.5 : 1.0) * (n < 3 ? 1.0 : 2.0)) * (at(p, i) * at(q, j) + at(p, j) * at(q, i));
    }
  T mixed[voigt_size][voigt_size];  // A_IJPQ C_PM C_QN
#pragma GCC unroll 6
  for (int m = 0; m < voigt_size; ++m)
#pragma GCC unroll 6
    for (int n = 0; n < voigt_size; ++n) {
      mixed[m][n] = A(m, 0) * pull[0][n];
#pragma GCC unroll 6
      for (int k = 1; k < voigt_size; ++k) mixed[m][n] += A(m, k) * pull[k][n];
    }
  T squared(0.0);
#pragma GCC unroll 6
  for (int m = 0; m < voigt_size; ++m)
#pragma GCC unroll 6
    for (int n = 0; n < voigt_size; ++n) squared += mixed[m][n] * mixed[n][m];
  return squared;
}

}  // namespace tunica::wall
