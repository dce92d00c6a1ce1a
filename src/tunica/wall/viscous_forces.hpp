// Forces of the viscosity of the wall, (1.19):
//   newtonian: sigma_v = 2 eta dev d,   d = sym(l),   l = sum_b v_b (x) g_b,   g_b = F^-T grad_X N_b,
//              r_a += V J sigma_v g_a;
//   potential: S_v = eta dE/dt,   r_a += V F S_v grad_X N_a.
// F leads from the imaged shape to the present one, whatever prestress the wall has.
#pragma once

#include "tunica/base/tensor.hpp"
#include "tunica/wall/viscosity.hpp"

namespace tunica::wall {

/// A point of quadrature of an element with N nodes.
template <class T, int N>
struct ViscousPoint {
  Vec3<T> dN[N];            ///< grad_X N_a [1/m]
  T volume;                 ///< the share of the point [m^3]
  Vec3<T> displacement[N];  ///< [m]
  Vec3<T> velocity[N];      ///< [m/s]

  /// sum of values (x) grad_X N_a.
  Mat3<T> gradient(const Vec3<T> (&values)[N]) const {
    Mat3<T> g{};
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) g(i, j) += values[a][i] * dN[a][j];
    return g;
  }
};

/// Derivatives of displacement and velocity with respect to the unknown.
struct ViscousCoefficients {
  double displacement, velocity;
};

namespace detail {

/// m += factor u (x) v.
template <class T>
void add_dyad(Mat3<T>& m, const T& factor, const Vec3<T>& u, const Vec3<T>& v) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) += factor * u[i] * v[j];
}

template <class T, int N>
void add_newtonian(const ViscousPoint<T, N>& p, double eta, const ViscousCoefficients& c, Vec3<T> (&r)[N],
                   Mat3<T> (*k)[N]) {
  const Mat3<T> F = identity<T>() + p.gradient(p.displacement), inverse_F = inverse(F),
                l = p.gradient(p.velocity) * inverse_F;
  const T weight = p.volume * determinant(F);
  const Mat3<T> sigma = T(eta) * (l + transpose(l) + (T(-2.0 / 3.0) * trace(l)) * identity<T>());
  Vec3<T> g[N], t[N];
  for (int a = 0; a < N; ++a) {
    g[a] = transpose(inverse_F) * p.dN[a];
    t[a] = weight * (sigma * g[a]);
    r[a] = r[a] + t[a];
  }
  for (int a = 0; a < N && k != nullptr; ++a)
    for (int b = 0; b < N; ++b) {
      Mat3<T> by_velocity = (weight * T(eta) * dot(g[a], g[b])) * identity<T>();
      add_dyad(by_velocity, weight * T(eta), g[b], g[a]);
      add_dyad(by_velocity, T(-2.0 / 3.0) * weight * T(eta), g[a], g[b]);
      k[a][b] = k[a][b] + T(c.velocity) * by_velocity + T(-c.displacement) * (by_velocity * l);
      add_dyad(k[a][b], T(c.displacement), t[a], g[b]);
      add_dyad(k[a][b], T(-c.displacement), t[b], g[a]);
    }
}

template <class T, int N>
void add_potential(const ViscousPoint<T, N>& p, double eta, const ViscousCoefficients& c, Vec3<T> (&r)[N],
                   Mat3<T> (*k)[N]) {
  const Mat3<T> F = identity<T>() + p.gradient(p.displacement), L = p.gradient(p.velocity), product = transpose(F) * L;
  const T half = T(0.5 * eta) * p.volume;
  const Mat3<T> S = half * (product + transpose(product)), FF = F * transpose(F), FL = F * transpose(L);
  Vec3<T> f[N], w[N];
  for (int a = 0; a < N; ++a) {
    f[a] = F * p.dN[a];
    w[a] = L * p.dN[a];
    r[a] = r[a] + F * (S * p.dN[a]);
  }
  for (int a = 0; a < N && k != nullptr; ++a)
    for (int b = 0; b < N; ++b) {
      const T gradients = half * dot(p.dN[a], p.dN[b]), geometric = dot(p.dN[a], S * p.dN[b]);
      k[a][b] =
          k[a][b] + (T(c.velocity) * gradients) * FF + T(c.displacement) * (gradients * FL + geometric * identity<T>());
      add_dyad(k[a][b], T(c.velocity) * half, f[b], f[a]);
      add_dyad(k[a][b], T(c.displacement) * half, f[b], w[a]);
    }
}

}  // namespace detail

/// Adds the forces of the point [N] to `r`, and where `k` is given their tangent.
template <class T, int N>
void add_viscous_forces(const ViscousPoint<T, N>& p, const Viscosity& viscosity, const ViscousCoefficients& c,
                        Vec3<T> (&r)[N], Mat3<T> (*k)[N]) {
  if (viscosity.law == Viscosity::Law::newtonian)
    detail::add_newtonian(p, viscosity.value, c, r, k);
  else
    detail::add_potential(p, viscosity.value, c, r, k);
}

}  // namespace tunica::wall
