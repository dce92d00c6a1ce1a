// Loads and tissue support on the quadratic triangle of a wall surface: corners, then the nodes on the edges 01 12 20.
//
// Signs and areas are those of surface.hpp. In the reference edges are straight. There a constant traction acts on the
// nodes of the edges alone, a third of the area each: the integral of a corner's shape function vanishes.
#pragma once

#include <type_traits>

#include "tunica/fe/quadratic_mass.hpp"
#include "tunica/wall/surface.hpp"

namespace tunica::wall::quadratic {

inline constexpr int triangle_nodes = 6;

/// Residual [N] and tangent of a triangle.
template <class T>
struct SurfaceVector {
  Vec3<T> r[triangle_nodes];
};
template <class T>
struct SurfaceMatrix {
  Mat3<T> k[triangle_nodes][triangle_nodes];
};

/// Nodes of a loaded triangle.
template <class T>
struct SurfaceState {
  Vec3<T> X[triangle_nodes];         ///< reference positions [m]
  Vec3<T> u[triangle_nodes];         ///< displacements [m]
  Vec3<T> velocity[triangle_nodes];  ///< du/dt [m/s]
};

namespace detail {

/// Derivatives of the shape functions with respect to l1 and l2, l0 = 1 - l1 - l2.
struct Slopes {
  double first[triangle_nodes], second[triangle_nodes];
};
constexpr Slopes slopes(const double (&l)[3]) {
  return {{1 - 4 * l[0], 4 * l[1] - 1, 0, 4 * (l[0] - l[1]), 4 * l[2], -4 * l[2]},
          {1 - 4 * l[0], 0, 4 * l[2] - 1, -4 * l[1], 4 * l[1], 4 * (l[0] - l[2])}};
}

template <class T>
inline Vec3<T> reference_area(const SurfaceState<T>& s) {
  const Vec3<T> corners[3] = {s.X[0], s.X[1], s.X[2]};
  return area_vector(corners);
}

template <class T>
inline void add_constant(const Vec3<T>& force, SurfaceVector<T>& r) {
  for (int a = 3; a < triangle_nodes; ++a) r.r[a] = r.r[a] + T(1.0 / 3.0) * force;
}

}  // namespace detail

/// Dead traction t [Pa].
template <class T>
inline void add_dead_traction(const SurfaceState<T>& s, const Vec3<T>& t, SurfaceVector<T>& r) {
  detail::add_constant(-norm(detail::reference_area(s)) * t, r);
}

/// Dead pressure p [Pa], positive towards the wall.
template <class T>
inline void add_dead_pressure(const SurfaceState<T>& s, const T& p, SurfaceVector<T>& r) {
  detail::add_constant(p * detail::reference_area(s), r);
}

/// Dead traction [Pa] that the shape functions interpolate between the nodes.
template <class T>
inline void add_dead_traction(const SurfaceState<T>& s, const Vec3<T> (&t)[triangle_nodes], SurfaceVector<T>& r) {
  const T area = norm(detail::reference_area(s));
  for (int a = 0; a < triangle_nodes; ++a)
    for (int b = 0; b < triangle_nodes; ++b) r.r[a] = r.r[a] - (area * T(fe::quadratic_triangle_mass[a][b])) * t[b];
}

/// Dead pressure [Pa] of the same kind.
template <class T>
inline void add_dead_pressure(const SurfaceState<T>& s, const T (&p)[triangle_nodes], SurfaceVector<T>& r) {
  const Vec3<T> area = detail::reference_area(s);
  for (int a = 0; a < triangle_nodes; ++a)
    for (int b = 0; b < triangle_nodes; ++b) r.r[a] = r.r[a] + (T(fe::quadratic_triangle_mass[a][b]) * p[b]) * area;
}

/// Pressure p [Pa] on the deformed triangle, r_a += p int N_a x,1 x x,2: a polynomial of degree 4, so that the seven
/// points are exact. Where `k` is given, adds the tangent with respect to u, times du/dx:
///   d (x,1 x x,2) = d x (N_b,1 x,2 - N_b,2 x,1) for a displacement d of the node b.
/// `pressure(N)`: p where the shape functions are N. Of one that varies linearly the points leave nothing out either.
template <class T, class Pressure>
inline void add_varying_pressure(const SurfaceState<T>& s, const Pressure& pressure, double du_dx, SurfaceVector<T>& r,
                                 std::type_identity_t<SurfaceMatrix<T>>* k) {
  for (const auto& point : fe::quadratic_seven_points) {
    const T p = pressure(point.N);
    const detail::Slopes dN = detail::slopes(point.barycentric);
    Vec3<T> first{{T(0.0), T(0.0), T(0.0)}}, second = first;
    for (int b = 0; b < triangle_nodes; ++b) {
      const Vec3<T> x = s.X[b] + s.u[b];
      first = first + T(dN.first[b]) * x;
      second = second + T(dN.second[b]) * x;
    }
    const Vec3<T> force = T(0.5 * point.weight) * p * cross(first, second);
    for (int a = 0; a < triangle_nodes; ++a) r.r[a] = r.r[a] + T(point.N[a]) * force;
    if (k == nullptr) continue;
    for (int b = 0; b < triangle_nodes; ++b) {
      const Vec3<T> w = T(0.5 * point.weight * du_dx) * p * (T(dN.first[b]) * second + T(-dN.second[b]) * first);
      for (int a = 0; a < triangle_nodes; ++a)
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3, l = (i + 2) % 3;  // (d x w)_i = d_j w_l - d_l w_j
          k->k[a][b](i, j) += T(point.N[a]) * w[l];
          k->k[a][b](i, l) -= T(point.N[a]) * w[j];
        }
    }
  }
}

/// The same on the whole triangle.
template <class T>
inline void add_follower_pressure(const SurfaceState<T>& s, const T& p, double du_dx, SurfaceVector<T>& r,
                                  std::type_identity_t<SurfaceMatrix<T>>* k) {
  add_varying_pressure(
      s, [&p](const auto&) { return p; }, du_dx, r, k);
}

/// Interpolated between the nodes.
template <class T>
inline void add_follower_pressure(const SurfaceState<T>& s, const T (&p)[triangle_nodes], double du_dx,
                                  SurfaceVector<T>& r, std::type_identity_t<SurfaceMatrix<T>>* k) {
  const auto interpolated = [&p](const auto& N) {
    T sum(0.0);
    for (int a = 0; a < triangle_nodes; ++a) sum += T(N[a]) * p[a];
    return sum;
  };
  add_varying_pressure(s, interpolated, du_dx, r, k);
}

/// Springs and dampers with the consistent surface mass, and p0 on the deformed triangle. Where `k` is given, adds the
/// tangent for du/dx and d(du/dt)/dx.
template <class T>
inline void add_support(const SurfaceState<T>& s, const TissueSupport<T>& support, double du_dx, double dvelocity_dx,
                        SurfaceVector<T>& r, std::type_identity_t<SurfaceMatrix<T>>* k) {
  const Vec3<T> corners[3] = {s.X[0], s.X[1], s.X[2]};
  const auto g = wall::detail::support_geometry(corners, support.normal_only);
  const T area = T(12.0) * g.twelfth;
  Vec3<T> force[triangle_nodes];
  for (int a = 0; a < triangle_nodes; ++a)
    force[a] = area * (g.directions * (support.stiffness * s.u[a] + support.damping * s.velocity[a]));
  const Mat3<T> stiffness = (area * (T(du_dx) * support.stiffness + T(dvelocity_dx) * support.damping)) * g.directions;
  for (int a = 0; a < triangle_nodes; ++a)
    for (int b = 0; b < triangle_nodes; ++b) {
      const T mass(fe::quadratic_triangle_mass[a][b]);
      r.r[a] = r.r[a] + mass * force[b];
      if (k != nullptr) k->k[a][b] = k->k[a][b] + mass * stiffness;
    }
  add_follower_pressure(s, support.pressure, du_dx, r, k);
}

}  // namespace tunica::wall::quadratic
