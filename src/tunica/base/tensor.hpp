// Small fixed-size vectors and 3 x 3 tensors, templated on the scalar (double, Pack, Dual).
#pragma once

#include "tunica/base/pack.hpp"

namespace tunica {

template <class T>
struct Vec3 {
  T x[3];
  TUNICA_INLINE T& operator[](int i) { return x[i]; }
  TUNICA_INLINE const T& operator[](int i) const { return x[i]; }
};

/// Row-major 3 x 3 tensor.
template <class T>
struct Mat3 {
  T m[3][3];
  TUNICA_INLINE T& operator()(int i, int j) { return m[i][j]; }
  TUNICA_INLINE const T& operator()(int i, int j) const { return m[i][j]; }
};

template <class T>
TUNICA_INLINE Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class T>
TUNICA_INLINE Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class T>
TUNICA_INLINE Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
template <class T>
TUNICA_INLINE T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
TUNICA_INLINE Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
template <class T>
TUNICA_INLINE T norm(const Vec3<T>& a) {
  return sqrt(dot(a, a));
}
/// The direction of a, which is not zero.
template <class T>
TUNICA_INLINE Vec3<T> normalised(const Vec3<T>& a) {
  return (T(1.0) / norm(a)) * a;
}

template <class T>
TUNICA_INLINE Mat3<T> identity() {
  const T o(1.0), z(0.0);
  return {{{o, z, z}, {z, o, z}, {z, z, o}}};
}
template <class T>
TUNICA_INLINE Mat3<T> operator+(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a(i, j) + b(i, j);
  return r;
}
template <class T>
TUNICA_INLINE Mat3<T> operator*(const T& s, const Mat3<T>& a) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = s * a(i, j);
  return r;
}
template <class T>
TUNICA_INLINE Mat3<T> operator*(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return r;
}
template <class T>
TUNICA_INLINE Vec3<T> operator*(const Mat3<T>& a, const Vec3<T>& b) {
  Vec3<T> r;
  for (int i = 0; i < 3; ++i) r[i] = a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2];
  return r;
}
template <class T>
TUNICA_INLINE Mat3<T> transpose(const Mat3<T>& a) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a(j, i);
  return r;
}
template <class T>
TUNICA_INLINE T trace(const Mat3<T>& a) {
  return a(0, 0) + a(1, 1) + a(2, 2);
}
template <class T>
TUNICA_INLINE T double_dot(const Mat3<T>& a, const Mat3<T>& b) {
  T s = a(0, 0) * b(0, 0);
  for (int k = 1; k < 9; ++k) s += a(k / 3, k % 3) * b(k / 3, k % 3);
  return s;
}
template <class T>
TUNICA_INLINE T determinant(const Mat3<T>& a) {
  return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
         a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}
/// Transposed cofactors: adjugate(a) / determinant(a) is the inverse.
template <class T>
TUNICA_INLINE Mat3<T> adjugate(const Mat3<T>& a) {
  Mat3<T> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r(i, j) = a(j1, i1) * a(j2, i2) - a(j1, i2) * a(j2, i1);
    }
  return r;
}
template <class T>
TUNICA_INLINE Mat3<T> inverse(const Mat3<T>& a) {
  return (T(1.0) / determinant(a)) * adjugate(a);
}

}  // namespace tunica
