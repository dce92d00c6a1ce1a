// Tangent of the flow kernel (rbvms.hpp): derivative of the element residual with respect to (v_{n+1}, p_{n+alpha_f}).
//
// It is complete but for two choices: tau_M, tau_C and tau_B are held fixed, and so is the mesh (position, mesh
// velocity); rbvms_shape.hpp adds what the motion of the wall brings. With L = grad v, c the coefficient of the
// velocity, m that of the acceleration, W = L v' and
//   T_b = m N_b + c a.grad N_b,
//   dv'/dv_b = -tau_M rho (T_b I + c N_b L),   dv'/dp_b = -tau_M grad N_b,
// each 3 x 3 velocity block is
//   i_ab I + l_ab L + n_ab L^2 + V_b (x) grad N_a + U_b (x) (L^T grad N_a) + C grad N_a (x) grad N_b + viscosity slope.
// The coefficients are sums over the points q with weight w:
//   i_ab = sum H_a T_b + c e_a (v'.grad N_b) + c mu vol grad N_a.grad N_b
//   l_ab = sum c H_a N_b - E_a T_b,   n_ab = - sum c E_a N_b
//   H_a = w (rho N_a + tau_M rho^2 A.grad N_a),  e_a = w (rho N_a + tau_B v'.grad N_a),  E_a = tau_M rho e_a
//   V_b = sum Z T_b - c w rho v' N_b + c mu vol grad N_b,   U_b = sum c Z N_b,   Z = w tau_M rho (rho v' - tau_B W).
// Since a.grad N_b = a . (constant), the sums with T_b need only the vectors sum_q H_a a and the like, so that the
// points are gone before the loop over the columns b.
#pragma once

#include "tunica/fluid/rbvms.hpp"

namespace tunica::fluid {

namespace detail {

/// Sums over the points that do not depend on the node.
template <class T>
struct TangentPoints {
  Vec3<T> flux[4];       ///< A = a + v'
  Vec3<T> v_prime[4];    ///< v'
  T m[4];                ///< w tau_M rho
  Vec3<T> z[4];          ///< Z
  Vec3<T> sum_z, sum_v;  ///< sum Z, sum w rho v'
  Vec3<T> sum_m_a;       ///< sum w tau_M rho a
  Mat3<T> sum_z_a;       ///< sum Z (x) a
  T sum_m, sum_tau_c;    ///< sum w tau_M rho, sum w tau_C
};

/// What the row of node a contributes to all its blocks.
template <class T>
struct TangentRow {
  T h[4], e[4];        ///< H_a and E_a at the points
  T sum_h, sum_e;      ///< their sums
  Vec3<T> i_gradient;  ///< i_ab = (this) . grad N_b + m sum H_a N_b
  Vec3<T> e_a;         ///< sum E_a a
  T streamline;        ///< sum w tau_M rho A.grad N_a
  Vec3<T> turned;      ///< L^T grad N_a
};

/// What the column of node b contributes to all its blocks.
template <class T>
struct TangentColumn {
  Vec3<T> v, u;       ///< V_b, U_b
  Vec3<T> convected;  ///< L grad N_b
  Vec3<T> strain;     ///< 2 eps grad N_b (only where the viscosity varies)
  T continuity_n;     ///< sum c w tau_M rho N_b
  T continuity_t;     ///< sum w tau_M rho T_b
};

template <class T>
TUNICA_INLINE TangentPoints<T> tangent_points(const Flow<T>& f, const Tau<T>& tau, double rho) {
  TangentPoints<T> s;
  const T weight = T(0.25) * f.shape.volume;
  s.sum_z = s.sum_v = s.sum_m_a = zero_vector<T>();
  s.sum_z_a = zero_matrix<T>();
  s.sum_m = s.sum_tau_c = T(0.0);
  for (int q = 0; q < 4; ++q) {
    s.v_prime[q] = (-tau.m[q]) * momentum_residual(f, rho, q);
    s.flux[q] = f.a[q] + s.v_prime[q];
    s.m[q] = weight * tau.m[q] * T(rho);
    s.z[q] = (s.m[q] * T(rho)) * s.v_prime[q] - (s.m[q] * tau.b[q]) * (f.gradient * s.v_prime[q]);
    s.sum_z = s.sum_z + s.z[q];
    s.sum_v = s.sum_v + s.v_prime[q];
    add(s.sum_m_a, s.m[q], f.a[q]);
    add_outer(s.sum_z_a, s.z[q], f.a[q]);
    s.sum_m += s.m[q];
    s.sum_tau_c += tau.c[q];
  }
  s.sum_v = (weight * T(rho)) * s.sum_v;
  s.sum_tau_c *= weight;
  return s;
}

template <class T>
TUNICA_INLINE TangentRow<T> tangent_row(const Flow<T>& f, const Tau<T>& tau, const TangentPoints<T>& s, double rho,
                                        double c, int a) {
  TangentRow<T> row;
  const Vec3<T>& dN = f.shape.dN[a];
  const T weight = T(0.25) * f.shape.volume;
  row.streamline = T(0.0);
  row.i_gradient = (f.shape.volume * f.mu) * dN;
  row.e_a = zero_vector<T>();
  for (int q = 0; q < 4; ++q) {
    const T mass = weight * T(rho * (q == a ? alpha : beta));
    const T stream = s.m[q] * dot(s.flux[q], dN);
    const T e = mass + weight * tau.b[q] * dot(s.v_prime[q], dN);
    row.streamline += stream;
    row.h[q] = mass + T(rho) * stream;
    row.e[q] = T(rho) * tau.m[q] * e;
    add(row.i_gradient, row.h[q], f.a[q]);
    add(row.i_gradient, e, s.v_prime[q]);
    add(row.e_a, row.e[q], f.a[q]);
  }
  row.i_gradient = T(c) * row.i_gradient;
  row.e_a = T(c) * row.e_a;
  row.sum_h = sum4(row.h);
  row.sum_e = sum4(row.e);
  row.turned = transpose(f.gradient) * dN;
  return row;
}

template <class T, class Law>
TUNICA_INLINE TangentColumn<T> tangent_column(const Flow<T>& f, const TangentPoints<T>& s, double rho,
                                              const TimeCoefficients& time, int b) {
  TangentColumn<T> column;
  const Vec3<T>& dN = f.shape.dN[b];
  const T c(time.velocity), m(time.acceleration), weight = T(0.25) * f.shape.volume;
  const Vec3<T> z_n = blend(s.sum_z, s.z[b]);
  const Vec3<T> v_n = blend(s.sum_v, (weight * T(rho)) * s.v_prime[b]);
  column.u = c * z_n;
  column.v = c * (s.sum_z_a * dN - v_n) + m * z_n;
  add(column.v, c * f.mu * f.shape.volume, dN);
  column.convected = f.gradient * dN;
  const T m_n = blend(s.sum_m, s.m[b]);
  column.continuity_n = c * m_n;
  column.continuity_t = m * m_n + c * dot(s.sum_m_a, dN);
  if constexpr (!Law::constant) column.strain = column.convected + transpose(f.gradient) * dN;
  return column;
}

}  // namespace detail

/// k[a][b][i][j] = d r[a][i] / d x[b][j] for given, fixed stabilisation parameters; x = (v_{n+1}, p_{n+1}).
template <class Law, class T>
TUNICA_INLINE void tangent_with(const Flow<T>& f, const Tau<T>& tau, const TimeCoefficients& time, double rho,
                                fe::ElementMatrix<T>& k) {
  using namespace detail;
  const TangentPoints<T> s = tangent_points(f, tau, rho);
  TangentColumn<T> columns[4];
  for (int b = 0; b < 4; ++b) columns[b] = tangent_column<T, Law>(f, s, rho, time, b);
  const Mat3<T> L = f.gradient, L2 = L * L;
  const T c(time.velocity), m(time.acceleration), by_rho(1.0 / rho);
  const T weight = T(0.25) * f.shape.volume;
  const Vec3<T> z_by_rho = by_rho * s.sum_z;
  const T c_tau_c = c * s.sum_tau_c;
  for (int a = 0; a < 4; ++a) {
    const TangentRow<T> row = tangent_row(f, tau, s, rho, time.velocity, a);
    const Vec3<T>& dNa = f.shape.dN[a];
    const T e_by_rho = by_rho * row.sum_e;
    for (int b = 0; b < 4; ++b) {
      const Vec3<T>& dNb = f.shape.dN[b];
      const TangentColumn<T>& column = columns[b];
      const T h_n = blend(row.sum_h, row.h[b]), e_n = blend(row.sum_e, row.e[b]);
      const T i_ab = m * h_n + dot(row.i_gradient, dNb);
      const T l_ab = c * h_n - m * e_n - dot(row.e_a, dNb);
      const T n_ab = -c * e_n;
      const T gradients = dot(dNa, dNb);
      T(&block)[4][4] = k.k[a][b];
      for (int i = 0; i < 3; ++i) {
        const T tau_dN = c_tau_c * dNa[i];
        for (int j = 0; j < 3; ++j) {
          T entry =
              l_ab * L(i, j) + n_ab * L2(i, j) + column.v[i] * dNa[j] + column.u[i] * row.turned[j] + tau_dN * dNb[j];
          if (i == j) entry += i_ab;
          if constexpr (!Law::constant)
            entry += (c * f.shape.volume * f.slope_over_rate) * columns[a].strain[i] * column.strain[j];
          block[i][j] = entry;
        }
        block[i][3] =
            row.streamline * dNb[i] - e_by_rho * column.convected[i] + gradients * z_by_rho[i] - weight * dNa[i];
        block[3][i] = c * weight * dNb[i] + column.continuity_t * dNa[i] + column.continuity_n * row.turned[i];
      }
      block[3][3] = by_rho * s.sum_m * gradients;
    }
  }
}

/// Residual and tangent of an element; see residual() and tangent_with().
template <class T, class Law>
inline void tangent(const ElementState<T>& state, const TimeCoefficients& time, const Parameters& parameters,
                    const Law& law, fe::ElementVector<T>& r, fe::ElementMatrix<T>& k) {
  const Flow<T> f = evaluate(state, law);
  const Tau<T> tau = stabilisation(f, time.dt, parameters);
  residual_with(f, tau, parameters.density, r);
  tangent_with<Law>(f, tau, time, parameters.density, k);
}

}  // namespace tunica::fluid
