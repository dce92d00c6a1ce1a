// Loads and tissue support on the linear triangle of a wall surface.
//
// Nodes are ordered so that (x1 - x0) x (x2 - x0) points out of the wall. Residuals are internal minus external force,
// as in element.hpp: a kernel adds its forces with the sign in which they belong into the residual.
//
// Dead loads and the tissue support act on the reference area, pressures on the current one.
#pragma once

#include "tunica/base/tensor.hpp"

namespace tunica::wall {

inline constexpr int triangle_nodes = 3;

/// Residual of a triangle: [node][direction] [N].
template <class T>
struct SurfaceVector {
  T r[triangle_nodes][3];
};

/// Tangent of a triangle: [row node][column node][row direction][column direction].
template <class T>
struct SurfaceMatrix {
  T k[triangle_nodes][triangle_nodes][3][3];
};

/// Area vector (area times unit normal) of the triangle x [m^2].
template <class T>
TUNICA_INLINE Vec3<T> area_vector(const Vec3<T> (&x)[triangle_nodes]) {
  return T(0.5) * cross(x[1] - x[0], x[2] - x[0]);
}

/// Dead traction t [Pa] on the reference triangle X: r_a -= t A / 3. Has no tangent.
template <class T>
TUNICA_INLINE void add_dead_traction(const Vec3<T> (&X)[triangle_nodes], const Vec3<T>& t, SurfaceVector<T>& r) {
  const Vec3<T> force = T(1.0 / 3.0) * norm(area_vector(X)) * t;
#pragma GCC unroll 3
  for (int a = 0; a < triangle_nodes; ++a)
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) r.r[a][i] -= force[i];
}

/// Pressure p [Pa], positive towards the wall, on the triangle x: r_a += p n A / 3. With current nodes it follows the
/// deformation (p n da = p cof(F) N dA, exact since the area vector is constant), with reference nodes it is dead.
template <class T>
TUNICA_INLINE void add_pressure(const Vec3<T> (&x)[triangle_nodes], const T& p, SurfaceVector<T>& r) {
  const Vec3<T> force = T(1.0 / 3.0) * p * area_vector(x);
#pragma GCC unroll 3
  for (int a = 0; a < triangle_nodes; ++a)
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) r.r[a][i] += force[i];
}

/// Tangent of the follower pressure with respect to u, times du/dx. Not symmetric for an open surface. Adding a
/// displacement d to node b changes x0 x x1 + x1 x x2 + x2 x x0 by d x (x_{b+1} - x_{b+2}).
template <class T>
TUNICA_INLINE void add_pressure_tangent(const Vec3<T> (&x)[triangle_nodes], const T& p, double du_dx,
                                        SurfaceMatrix<T>& m) {
#pragma GCC unroll 3
  for (int b = 0; b < triangle_nodes; ++b) {
    const Vec3<T> w = T(du_dx / 6.0) * p * (x[(b + 1) % 3] - x[(b + 2) % 3]);
#pragma GCC unroll 3
    for (int a = 0; a < triangle_nodes; ++a)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;  // (d x w)_i = d_j w_k - d_k w_j
        m.k[a][b][i][j] += w[k];
        m.k[a][b][i][k] -= w[j];
      }
  }
}

/// Tissue around the vessel: sigma n = -k u - c u_dot - p0 n (formulation of Moireau et al. 2012).
template <class T>
struct TissueSupport {
  T stiffness;               ///< k [N/m^3], per reference area
  T damping;                 ///< c [N s/m^3], per reference area
  T pressure;                ///< p0 [Pa], on the current area
  bool normal_only = false;  ///< k and c act along the reference normal only
};

/// Nodes of a supported triangle.
template <class T>
struct SupportState {
  Vec3<T> X[triangle_nodes];         ///< reference positions [m]
  Vec3<T> u[triangle_nodes];         ///< displacements [m]
  Vec3<T> velocity[triangle_nodes];  ///< du/dt [m/s]
};

namespace detail {

/// A/12 and the projector on the supported directions: identity or N (x) N.
template <class T>
struct SupportGeometry {
  T twelfth;
  Mat3<T> directions;
};

template <class T>
TUNICA_INLINE SupportGeometry<T> support_geometry(const Vec3<T> (&X)[triangle_nodes], bool normal_only) {
  const Vec3<T> A = area_vector(X);
  const T area = norm(A);
  SupportGeometry<T> g{T(1.0 / 12.0) * area, identity<T>()};
  if (normal_only) {
    const T inverse_square = T(1.0) / (area * area);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) g.directions(i, j) = inverse_square * A[i] * A[j];
  }
  return g;
}

template <class T>
TUNICA_INLINE void current_positions(const SupportState<T>& s, Vec3<T> (&x)[triangle_nodes]) {
  for (int a = 0; a < triangle_nodes; ++a) x[a] = s.X[a] + s.u[a];
}

}  // namespace detail

/// Residual of the support: springs and dampers with the consistent surface mass A (1 + delta_ab) / 12.
template <class T>
TUNICA_INLINE void add_support(const SupportState<T>& s, const TissueSupport<T>& support, SurfaceVector<T>& r) {
  const detail::SupportGeometry<T> g = detail::support_geometry(s.X, support.normal_only);
  Vec3<T> force[triangle_nodes], sum{{T(0.0), T(0.0), T(0.0)}};
#pragma GCC unroll 3
  for (int a = 0; a < triangle_nodes; ++a) {
    force[a] = g.directions * (support.stiffness * s.u[a] + support.damping * s.velocity[a]);
    sum = sum + force[a];
  }
#pragma GCC unroll 3
  for (int a = 0; a < triangle_nodes; ++a)
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) r.r[a][i] += g.twelfth * (sum[i] + force[a][i]);
  Vec3<T> x[triangle_nodes];
  detail::current_positions(s, x);
  add_pressure(x, support.pressure, r);
}

/// Tangent of the support for du/dx and d(du/dt)/dx.
template <class T>
TUNICA_INLINE void add_support_tangent(const SupportState<T>& s, const TissueSupport<T>& support, double du_dx,
                                       double dvelocity_dx, SurfaceMatrix<T>& m) {
  const detail::SupportGeometry<T> g = detail::support_geometry(s.X, support.normal_only);
  const T weight = g.twelfth * (T(du_dx) * support.stiffness + T(dvelocity_dx) * support.damping);
  const Mat3<T> k = weight * g.directions;
#pragma GCC unroll 3
  for (int a = 0; a < triangle_nodes; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < triangle_nodes; ++b)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) m.k[a][b][i][j] += a == b ? k(i, j) + k(i, j) : k(i, j);
  Vec3<T> x[triangle_nodes];
  detail::current_positions(s, x);
  add_pressure_tangent(x, support.pressure, du_dx, m);
}

}  // namespace tunica::wall
