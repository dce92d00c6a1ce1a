// Dual<T, N>: forward differentiation, value and N partial derivatives. Nest for second derivatives.
#pragma once

#include <array>

#include "tunica/base/pack.hpp"

namespace tunica {

template <class T, int N>
struct Dual {
  T value{};
  std::array<T, N> d{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: implicit, so that literals mix with duals
  Dual(const T& v) requires(!std::is_same_v<T, double>) : value(v) {}  // NOLINT
  /// The independent variable number `i`.
  static Dual variable(const T& v, int i) {
    Dual r;
    r.value = v;
    r.d[i] = T(1.0);
    return r;
  }
  /// f(x) from f(x.value) and f'(x.value).
  static Dual chain(const Dual& x, const T& f, const T& df) {
    Dual r;
    r.value = f;
    for (int i = 0; i < N; ++i) r.d[i] = df * x.d[i];
    return r;
  }
  Dual operator-() const { return chain(*this, -value, T(-1.0)); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value + b.value;
    for (int i = 0; i < N; ++i) r.d[i] = a.d[i] + b.d[i];
    return r;
  }
  friend Dual operator-(const Dual& a, const Dual& b) { return a + (-b); }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value * b.value;
    for (int i = 0; i < N; ++i) r.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value / b.value;
    for (int i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.value * b.d[i]) / b.value;
    return r;
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
};

template <class T, int N>
Dual<T, N> select(bool mask, const Dual<T, N>& a, const Dual<T, N>& b) {
  return mask ? a : b;
}
template <class T, int N>
Dual<T, N> max(const Dual<T, N>& a, const Dual<T, N>& b) {
  return a > b ? a : b;
}
template <class T, int N>
Dual<T, N> min(const Dual<T, N>& a, const Dual<T, N>& b) {
  return a < b ? a : b;
}
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
  const T s = sqrt(x.value);
  return Dual<T, N>::chain(x, s, T(0.5) / s);
}
template <class T, int N>
Dual<T, N> abs(const Dual<T, N>& x) {
  return x < Dual<T, N>(0.0) ? -x : x;
}
template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& x) {
  const T e = exp(x.value);
  return Dual<T, N>::chain(x, e, e);
}
template <class T, int N>
Dual<T, N> log(const Dual<T, N>& x) {
  return Dual<T, N>::chain(x, log(x.value), T(1.0) / x.value);
}
template <class T, int N>
Dual<T, N> pow(const Dual<T, N>& x, double y) {
  return Dual<T, N>::chain(x, pow(x.value, y), T(y) * pow(x.value, y - 1.0));
}

}  // namespace tunica
