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
  const Vec3<T> n = area_vector(x);  // times area, which the weights below therefore leave out
  for (const fe::TrianglePoint& point : fe::three_points) {
    Vec3<T> v = detail::zero_vector<T>(), a = detail::zero_vector<T>();
    for (int b = 0; b < 3; ++b) {
      detail::add(v, T(point.barycentric[b]), velocity[b]);
      detail::add(a, T(point.barycentric[b]), velocity[b] - mesh_velocity[b]);
    }
    const T normal_flow = dot(a, n), zero(0.0);
    const auto inward = normal_flow < zero;
    const double factor = -parameters.backflow * parameters.density * point.weight;
    const T flow_in = T(factor) * select(inward, normal_flow, zero);
    for (int row = 0; row < 3; ++row) detail::add(r.r[row], T(point.barycentric[row]) * flow_in, v);
    if (k == nullptr) continue;
    const T slope = select(inward, T(factor), zero);
    Mat3<T> block;  // derivative of flow_in v with respect to v
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block(i, j) = slope * v[i] * n[j];
    for (int i = 0; i < 3; ++i) block(i, i) += flow_in;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        const T shape(point.barycentric[row] * point.barycentric[column] * velocity_coefficient);
        k->k[row][column] = k->k[row][column] + shape * block;
      }
  }
}

/// The same for a quadratic velocity on a straight-edged triangle (fe/quadratic_triangle.hpp): `v`, `v_hat` at its six
/// nodes. `take(a, b, block)` receives the tangent with respect to v_{n+1}, if `with_tangent`.
template <class T, class Take>
TUNICA_INLINE void add_quadratic_backflow(const Vec3<T>& area, const Vec3<T> (&v)[6], const Vec3<T> (&v_hat)[6],
                                          const Parameters& parameters, Vec3<T> (&r)[6], bool with_tangent,
                                          double velocity_coefficient, Take&& take) {
  Mat3<T> k[6][6];
  if (with_tangent)
    for (auto& row : k)
      for (auto& block : row) block = detail::zero_matrix<T>();
  for (const auto& point : fe::quadratic_seven_points) {
    Vec3<T> u = detail::zero_vector<T>(), a = detail::zero_vector<T>();
    for (int b = 0; b < 6; ++b) {
      detail::add(u, T(point.N[b]), v[b]);
      detail::add(a, T(point.N[b]), v[b] - v_hat[b]);
    }
    const T normal_flow = dot(a, area), zero(0.0);
    const auto inward = normal_flow < zero;
    const double factor = -parameters.backflow * parameters.density * point.weight;
    const T flow_in = T(factor) * select(inward, normal_flow, zero);
    for (int row = 0; row < 6; ++row) detail::add(r[row], T(point.N[row]) * flow_in, u);
    if (!with_tangent) continue;
    const T slope = select(inward, T(factor), zero);
    Mat3<T> block;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block(i, j) = slope * u[i] * area[j];
    for (int i = 0; i < 3; ++i) block(i, i) += flow_in;
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        k[row][column] = k[row][column] + T(point.N[row] * point.N[column] * velocity_coefficient) * block;
  }
  if (!with_tangent) return;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) take(row, column, k[row][column]);
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
