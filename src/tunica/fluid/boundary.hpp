// Flow through boundary triangles: pressure traction with backflow stabilisation (section 4), and what outlets and
// histories need (flow rate, mean pressure, wall shear stress).
//
// The nodes of a triangle run so that (x1 - x0) x (x2 - x0) points out of the flow. All functions are templated on
// T = double, Dual or Pack.
#pragma once

#include "tunica/fe/quadratic_triangle.hpp"
#include "tunica/fe/tetrahedron.hpp"
#include "tunica/fluid/rbvms.hpp"

namespace tunica::fluid {

/// Residual of a triangle, [node][component] [N].
template <class T>
struct TriangleVector {
  Vec3<T> r[3];
};

/// Tangent of a triangle: [row node][column node], each a 3 x 3 block [row component][column component].
template <class T>
struct TriangleMatrix {
  Mat3<T> k[3][3];
};

/// Area vector of a triangle: outward unit normal times area [m^2].
template <class T>
TUNICA_INLINE Vec3<T> area_vector(const Vec3<T> (&x)[3]) {
  return T(0.5) * cross(x[1] - x[0], x[2] - x[0]);
}

/// v_A = integral of N_A n over the triangle, the same for its three nodes [m^2].
template <class T>
TUNICA_INLINE Vec3<T> nodal_area_vector(const Vec3<T> (&x)[3]) {
  return T(1.0 / 3.0) * area_vector(x);
}

/// Area [m^2].
template <class T>
TUNICA_INLINE T area(const Vec3<T> (&x)[3]) {
  return norm(area_vector(x));
}

/// Outward volume flow relative to the moving triangle, integral of (v - v^).n [m^3/s].
template <class T>
TUNICA_INLINE T flow(const Vec3<T> (&x)[3], const Vec3<T> (&velocity)[3], const Vec3<T> (&mesh_velocity)[3]) {
  const Vec3<T> a =
      (velocity[0] - mesh_velocity[0]) + (velocity[1] - mesh_velocity[1]) + (velocity[2] - mesh_velocity[2]);
  return dot(nodal_area_vector(x), a);
}

/// Integral of the pressure over the triangle [N]; the mean pressure of a face is the sum of these over the sum of
/// areas.
template <class T>
TUNICA_INLINE T integrated_pressure(const Vec3<T> (&x)[3], const T (&pressure)[3]) {
  return area(x) * (pressure[0] + pressure[1] + pressure[2]) * T(1.0 / 3.0);
}

/// Residual of the traction -P n: r_A += P v_A. The triangle is the current one, so P follows the moving face.
template <class T>
TUNICA_INLINE void add_pressure(const Vec3<T> (&x)[3], const T& pressure, TriangleVector<T>& r) {
  const Vec3<T> force = pressure * nodal_area_vector(x);
  for (int a = 0; a < 3; ++a) r.r[a] = r.r[a] + force;
}

namespace detail {

/// The share of one point of the rule in the backflow stabilisation below. `N`: shape functions there, `area`: area
/// vector of the triangle; `k` may be null.
template <class T, int n>
TUNICA_INLINE void add_backflow_at(const double (&N)[n], double weight, const Vec3<T>& area,
                                   const Vec3<T> (&velocity)[n], const Vec3<T> (&mesh_velocity)[n],
                                   const Parameters& parameters, Vec3<T> (&r)[n], Mat3<T> (*k)[n],
                                   double velocity_coefficient) {
  Vec3<T> v = zero_vector<T>(), a = zero_vector<T>();
  for (int b = 0; b < n; ++b) {
    add(v, T(N[b]), velocity[b]);
    add(a, T(N[b]), velocity[b] - mesh_velocity[b]);
  }
  const T normal_flow = dot(a, area), zero(0.0);
  const auto inward = normal_flow < zero;
  const double factor = -parameters.backflow * parameters.density * weight;
  const T flow_in = T(factor) * select(inward, normal_flow, zero);
  for (int row = 0; row < n; ++row) add(r[row], T(N[row]) * flow_in, v);
  if (k == nullptr) return;
  const T slope = select(inward, T(factor), zero);
  Mat3<T> block;  // derivative of flow_in v with respect to v
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block(i, j) = slope * v[i] * area[j];
  for (int i = 0; i < 3; ++i) block(i, i) += flow_in;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      k[row][column] = k[row][column] + T(N[row] * N[column] * velocity_coefficient) * block;
}

}  // namespace detail

/// Backflow stabilisation (Esmaily Moghadam et al. 2011): the traction beta rho (a.n)_- v with (s)_- = min(s, 0) and
/// a = v - v^. Its power is beta rho (a.n)_- |v|^2 <= 0: it only takes energy out, and with beta = 1/2 exactly what an
/// inward flow carries in. It multiplies v, not a, for the power to have that sign on a moving face as well.
///
/// Adds to r[a] the integral of -N_a beta rho (a.n)_- v, evaluated at three points. Where `k` is given, adds the
/// tangent with respect to v_{n+1}: velocity_coefficient = d velocity / d v_{n+1}; exact except where a.n = 0.
template <class T>
TUNICA_INLINE void add_backflow(const Vec3<T> (&x)[3], const Vec3<T> (&velocity)[3], const Vec3<T> (&mesh_velocity)[3],
                                const Parameters& parameters, TriangleVector<T>& r, TriangleMatrix<T>* k = nullptr,
                                double velocity_coefficient = 0.0) {
  const Vec3<T> area = area_vector(x);
  for (const fe::TrianglePoint& point : fe::three_points)
    detail::add_backflow_at(point.barycentric, point.weight, area, velocity, mesh_velocity, parameters, r.r,
                            k != nullptr ? k->k : nullptr, velocity_coefficient);
}

/// The same for a quadratic velocity on a straight-edged triangle (fe/quadratic_triangle.hpp), at seven points. `k`
/// [6][6] may be null.
template <class T>
TUNICA_INLINE void add_quadratic_backflow(const Vec3<T>& area, const Vec3<T> (&velocity)[6],
                                          const Vec3<T> (&mesh_velocity)[6], const Parameters& parameters,
                                          Vec3<T> (&r)[6], Mat3<T> (*k)[6], double velocity_coefficient) {
  for (const auto& point : fe::quadratic_seven_points)
    detail::add_backflow_at(point.N, point.weight, area, velocity, mesh_velocity, parameters, r, k,
                            velocity_coefficient);
}

/// Wall shear stress: tangential part of the viscous traction mu (grad v + grad v^T) n that the wall exerts on the flow
/// with its outward unit normal n [Pa]. The flow drags the wall with the opposite vector. grad v is that of the element
/// behind the triangle, Flow::gradient.
template <class T>
TUNICA_INLINE Vec3<T> wall_shear_traction(const Mat3<T>& gradient, const T& mu, const Vec3<T>& n) {
  Vec3<T> t = mu * ((gradient + transpose(gradient)) * n);
  detail::add(t, -dot(t, n), n);
  return t;
}

}  // namespace tunica::fluid
