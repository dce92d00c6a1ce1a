// Wall kernels on the quadratic tetrahedron with straight edges: displacement element, and mixed element with linear
// pressure (Taylor & Hood 1973).
//
// The equations are those of element.hpp without the subscale: quadratic displacement and linear pressure satisfy the
// inf-sup condition, so that the constraint needs no stabilisation,
//   r_a   = (N_a, rho_0 v_dot) + (grad_X N_a, P_iso + (gamma c g' - p) J F^-T),   c = g(J) + p/K,
//   r_p,a = s (l_a, c).
//
// The term of gamma = mu K / (mu + K) adds gamma/2 c^2 to the energy (augmented Lagrangian; Glowinski & Le Tallec
// 1989). It vanishes with c, and r_p from it is (1 - gamma/K) of what it would be, which changes nothing. Without it
// the momentum equation at given p knows no resistance against dilation, and the Schur complement of the pressure is
// unbounded in thin walls.
//
// Gradients are linear in the element, and the forces are integrated with four points. All gradients are made up of the
// four constant ones of the barycentric coordinates, grad N_b = sum_k slope_bk g_k. At a point the element therefore is
// a linear one with displacements U_k = sum_b slope_bk u_b of its corners,
//   F = axes + sum_k U_k (x) g_k,   P grad N_b = sum_k slope_bk P g_k,
// and the kernels of the linear element serve each point: forces and tangent of its four corners are spread over ten.
//
// Prestress S0 or F0 (prestress.hpp) is that of each point, where the linear element takes it. Masses are those of the
// stress-free state: V_0 = sum_q w_q V / det F0_q.
#pragma once

#include <type_traits>

#include "tunica/fe/quadratic_mass.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::wall::quadratic {

inline constexpr int nodes = fe::quadratic_nodes;
inline constexpr int points = 4;

/// Nodal values of one element, or of a batch of elements; see the linear one.
template <class T>
struct ElementState {
  fe::Gradients<T> reference;    ///< of the barycentric coordinates, without any prestretch
  Mat3<T> axes = identity<T>();  ///< columns: axes of these gradients
  Vec3<T> displacement[nodes];   ///< u at t_{n+alpha_f} [m]
  Vec3<T> acceleration[nodes];   ///< v_dot at t_{n+alpha_m} [m/s^2]
  T pressure[fe::nodes];         ///< p of the corners at t_{n+alpha_f} [Pa], mixed element only
};

/// Prestress of one element, axes of its gradients.
template <class T>
struct PointPrestress {
  PrestressKind kind = PrestressKind::none;
  Symmetric<T> stress[points];  ///< S0 [Pa], unless of another kind
  Mat3<T> stretch[points];      ///< F0, unless of another kind

  /// S0 of a point; null where there is none.
  const Symmetric<T>* stress_of(int q) const { return kind == PrestressKind::stress ? &stress[q] : nullptr; }
};

/// Residual of an element: momentum of all nodes [N], constraint of the corners s [m^3].
template <class T>
struct ElementVector {
  Vec3<T> momentum[nodes];
  T constraint[fe::nodes];
};

/// One row of the tangent: what the node `a` of the residual feels of every column. Displacement elements have `motion`
/// alone.
template <class T>
struct TangentRow {
  Mat3<T> motion[nodes];         ///< d momentum / d x
  Vec3<T> pressure[fe::nodes];   ///< d momentum / d p
  Vec3<T> constraint[nodes];     ///< d constraint / d x; corners only
  T compressibility[fe::nodes];  ///< d constraint / d p; corners only
};

/// The linear element that stands for this one at a point: same F from the imaged shape, the pressure of the point at
/// all corners, no acceleration, the share of the point of the volume. Its displacements are those of the corner 0 and
/// what F needs.
template <class T>
inline wall::ElementState<T> at_point(const ElementState<T>& e, const fe::QuadraticPoint& point) {
  wall::ElementState<T> s;
  s.reference = e.reference;
  s.reference.volume = T(point.weight) * e.reference.volume;
  s.axes = e.axes;
  const Vec3<T> zero{{T(0.0), T(0.0), T(0.0)}};
  T pressure(0.0);
  for (int a = 0; a < fe::nodes; ++a) {
    s.displacement[a] = s.acceleration[a] = zero;
    pressure += T(point.barycentric[a]) * e.pressure[a];
  }
  for (int a = 0; a < fe::nodes; ++a) s.pressure[a] = pressure;
  for (int b = 1; b < nodes; ++b) {
    const Vec3<T> edge = e.displacement[b] - e.displacement[0];  // exact zero for a translation
    Vec3<T>&first = s.displacement[fe::gradient_of[b][0]], &second = s.displacement[fe::gradient_of[b][1]];
    first = first + T(point.slope[b][0]) * edge;
    if (b >= fe::nodes) second = second + T(point.slope[b][1]) * edge;
  }
  return s;
}

/// The same at the point of quadrature q, referred to its stress-free state where it is prestretched.
template <class T>
inline wall::ElementState<T> at_point(const ElementState<T>& e, int q,
                                      const std::type_identity_t<PointPrestress<T>>& prestress) {
  wall::ElementState<T> s = at_point(e, fe::quadratic_four_points[static_cast<std::size_t>(q)]);
  if (prestress.kind == PrestressKind::stretch) set_prestretch(s, prestress.stretch[q]);
  return s;
}

/// Volume of the stress-free state [m^3].
template <class T>
inline T stress_free_volume(const ElementState<T>& e, const std::type_identity_t<PointPrestress<T>>& prestress) {
  if (prestress.kind != PrestressKind::stretch) return e.reference.volume;
  T sum(0.0);
  for (int q = 0; q < points; ++q)
    sum += T(fe::quadratic_four_points[static_cast<std::size_t>(q)].weight) * e.reference.volume /
           determinant(prestress.stretch[q]);
  return sum;
}

/// Mean of the points, which is the value at the centroid of what is linear between them.
template <class Value>
inline Value mean_of_points(const Value (&values)[points]) {
  return 0.25 * (values[0] + values[1] + values[2] + values[3]);
}

/// The same at the centroid with all of the volume, the mean prestretch, and the displacement of the centroid in the
/// mean: what outputs with one value for each element are taken from.
inline wall::ElementState<double> at_centroid(const ElementState<double>& e, const PointPrestress<double>& prestress) {
  constexpr fe::QuadraticPoint centroid = fe::quadratic_point({0.25, 0.25, 0.25, 0.25}, 1.0);
  wall::ElementState<double> s = at_point(e, centroid);
  Vec3<double> shift{};
  for (int b = 0; b < nodes; ++b) shift = shift + centroid.N[b] * e.displacement[b];
  for (int a = 0; a < fe::nodes; ++a) shift = shift - 0.25 * s.displacement[a];
  for (int a = 0; a < fe::nodes; ++a) s.displacement[a] = s.displacement[a] + shift;
  if (prestress.kind == PrestressKind::stretch) set_prestretch(s, mean_of_points(prestress.stretch));
  return s;
}

namespace detail {

/// Forces of the four corners at a point, spread over the nodes.
template <class T>
inline void spread(const fe::ElementVector<T>& force, const fe::QuadraticPoint& point, ElementVector<T>& r) {
  for (int b = 0; b < nodes; ++b) {
    const auto &first = force.r[fe::gradient_of[b][0]], &second = force.r[fe::gradient_of[b][1]];
    for (int i = 0; i < 3; ++i) {
      r.momentum[b][i] += T(point.slope[b][0]) * first[i];
      if (b >= fe::nodes) r.momentum[b][i] += T(point.slope[b][1]) * second[i];
    }
  }
}

/// Sum over the gradients that make up that of the node b.
template <class Value, class Scalar>
TUNICA_INLINE Value combined(const Value (&of_corner)[fe::nodes], const fe::QuadraticPoint& point, int b,
                             const Scalar& weight) {
  const Value first = (weight * Scalar(point.slope[b][0])) * of_corner[fe::gradient_of[b][0]];
  if (b < fe::nodes) return first;
  return first + (weight * Scalar(point.slope[b][1])) * of_corner[fe::gradient_of[b][1]];
}

/// Inertia with the consistent mass [kg]; sets all of the residual.
template <class T>
inline void start(const ElementState<T>& e, const T& mass, ElementVector<T>& r) {
  for (int a = 0; a < nodes; ++a) {
    Vec3<T> sum = T(fe::quadratic_mass[a][0]) * e.acceleration[0];
    for (int b = 1; b < nodes; ++b) sum = sum + T(fe::quadratic_mass[a][b]) * e.acceleration[b];
    r.momentum[a] = mass * sum;
  }
  for (T& c : r.constraint) c = T(0.0);
}

/// gamma of the mixed element [Pa]: shear modulus at rest and bulk modulus in series, so that gamma/K < 1.
template <class T, class L, class U>
TUNICA_INLINE T augmentation(const L& law, const BodyOf<U>& body) {
  const T mu(law.shear_modulus_at_rest());
  return mu / (T(1.0) + mu * T(body.volumetric.compressibility()));
}

/// pi of element.hpp: the Kirchhoff stress J p_vol, or J (gamma c g' - p), and its derivatives.
template <class T>
struct IsotropicStress {
  T pi;        ///< [Pa]
  T kappa;     ///< J dpi/dJ [Pa], at fixed p
  T pressure;  ///< -1/J dpi/dp [-]
};

template <bool mixed, class T, class L, class U>
TUNICA_INLINE IsotropicStress<T> isotropic_stress(const wall::ElementState<T>& s, const T& J, const L& law,
                                                  const BodyOf<U>& body) {
  const T g = body.volumetric.unit_pressure(J), slope = body.volumetric.unit_stiffness(J);
  if constexpr (mixed) {
    const T gamma = augmentation<T>(law, body), compressibility(body.volumetric.compressibility());
    const T c = g + compressibility * s.pressure[0];
    const T pi = J * (gamma * c * slope - s.pressure[0]);
    return {pi, pi + J * J * gamma * (slope * slope + c * body.volumetric.unit_curvature(J)),
            T(1.0) - gamma * compressibility * slope};
  } else {
    const T bulk(body.volumetric.bulk_modulus), pi = bulk * J * g;
    return {pi, pi + bulk * J * J * slope, T(0.0)};
  }
}

template <class T, class U>
TUNICA_INLINE void add_constraint(const wall::ElementState<T>& s, const T& J, const fe::QuadraticPoint& point,
                                  const BodyOf<U>& body, double factor, ElementVector<T>& r) {
  const T value = T(factor) * s.reference.volume *
                  (body.volumetric.unit_pressure(J) + T(body.volumetric.compressibility()) * s.pressure[0]);
  for (int a = 0; a < fe::nodes; ++a) r.constraint[a] += T(point.barycentric[a]) * value;
}

/// Internal forces of the corners at a point. Out of line, as the linear kernels are inlined into it.
template <class T, class L>
[[gnu::noinline]] void point_forces(const wall::ElementState<T>& s, const Kinematics<T>& k, const L& law, const T& pi,
                                    const std::type_identity_t<Symmetric<T>>* S0, fe::ElementVector<T>& force) {
  wall::detail::add_momentum(s, k, law, pi, T(0.0), force);
  if (S0 != nullptr) add_prestress_residual(s, *S0, force);
}

/// The same with the tangent of the motion; kappa = J dpi/dJ.
template <class T, class L>
[[gnu::noinline]] void point_tangent(const wall::ElementState<T>& s, const Kinematics<T>& k, const L& law, const T& pi,
                                     const T& kappa, double du_dx, const std::type_identity_t<Symmetric<T>>* S0,
                                     fe::ElementVector<T>& force, Mat3<T> (&stiffness)[fe::nodes][fe::nodes]) {
  fe::ElementMatrix<T> m;
  const Coefficients c{.acceleration = 0.0, .displacement = du_dx, .constraint = 0.0};
  wall::detail::add_momentum(s, k, law, pi, kappa, T(0.0), c, force, m);
  if (S0 != nullptr) {
    add_prestress_residual(s, *S0, force);
    add_prestress_tangent(s, *S0, c, m);
  }
  for (int a = 0; a < fe::nodes; ++a)
    for (int b = 0; b < fe::nodes; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stiffness[a][b](i, j) = m.k[a][b][i][j];
}

/// What the rows of the tangent need of a point.
template <class T>
struct PointTangent {
  Mat3<T> stiffness[fe::nodes][fe::nodes];
  Vec3<T> dilation[fe::nodes];  ///< V J grad_x l_a
  T slope;                      ///< s du/dx dg/dJ
  T push;                       ///< of the pressure, times the dilation [-]
  T spring;                     ///< s/K times the share of the stress-free volume
};

/// The law at a point: that of the element, unless its materials have another share at each.
template <class L>
TUNICA_INLINE decltype(auto) law_at(const L& law, int q) {
  if constexpr (requires { law.at_point(q); })
    return law.at_point(q);
  else
    return (law);
}

/// Row a, pressure parts of the mixed element.
template <class T>
inline void pressure_of_row(const PointTangent<T> (&tangents)[points], int a, TangentRow<T>& row) {
  const Vec3<T> zero{{T(0.0), T(0.0), T(0.0)}};
  for (Vec3<T>& column : row.pressure) column = zero;
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_four_points[q];
    const Vec3<T> push = combined(tangents[q].dilation, point, a, -tangents[q].push);
    for (int b = 0; b < fe::nodes; ++b) row.pressure[b] = row.pressure[b] + T(point.barycentric[b]) * push;
  }
  if (a >= fe::nodes) return;
  for (int b = 0; b < fe::nodes; ++b) {
    T mass(0.0);
    for (int q = 0; q < points; ++q) {
      const auto& point = fe::quadratic_four_points[q];
      mass += T(point.barycentric[a] * point.barycentric[b]) * tangents[q].spring;
    }
    row.compressibility[b] = mass;
  }
  for (int b = 0; b < nodes; ++b) {
    row.constraint[b] = zero;
    for (int q = 0; q < points; ++q) {
      const auto& point = fe::quadratic_four_points[q];
      const T weight = T(point.barycentric[a]) * tangents[q].slope;
      row.constraint[b] = row.constraint[b] + combined(tangents[q].dilation, point, b, weight);
    }
  }
}

template <class T>
inline void motion_of_row(const PointTangent<T> (&tangents)[points], int a, const T& mass, TangentRow<T>& row) {
  for (int b = 0; b < nodes; ++b)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) row.motion[b](i, j) = i == j ? T(fe::quadratic_mass[a][b]) * mass : T(0.0);
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_four_points[q];
    const int first = fe::gradient_of[a][0], second = fe::gradient_of[a][1];
    Mat3<T> corner[fe::nodes];
    for (int b = 0; b < fe::nodes; ++b) {
      corner[b] = T(point.slope[a][0]) * tangents[q].stiffness[first][b];
      if (a >= fe::nodes) corner[b] = corner[b] + T(point.slope[a][1]) * tangents[q].stiffness[second][b];
    }
    for (int b = 0; b < nodes; ++b) row.motion[b] = row.motion[b] + combined(corner, point, b, T(1.0));
  }
}

}  // namespace detail

/// Residual of the mixed or the displacement element (finite K).
template <bool mixed, class T, class L, class U>
inline void residual(const ElementState<T>& e, const L& law, const BodyOf<U>& body, const Coefficients& c,
                     const std::type_identity_t<PointPrestress<T>>& prestress, ElementVector<T>& r) {
  detail::start(e, T(body.density) * stress_free_volume(e, prestress), r);
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_four_points[q];
    const wall::ElementState<T> s = at_point(e, q, prestress);
    const Kinematics<T> k = kinematics(s);
    fe::ElementVector<T> force;
    const auto& here = detail::law_at(law, q);
    const auto body_here = body.at_point(q);
    detail::point_forces(s, k, here, detail::isotropic_stress<mixed>(s, k.J, here, body_here).pi,
                         prestress.stress_of(q), force);
    detail::spread(force, point, r);
    if constexpr (mixed) detail::add_constraint(s, k.J, point, body_here, c.constraint, r);
  }
}

/// The same with the tangent, whose rows `take(a, row)` receives one after another: all of it at once would not stay
/// in the nearest cache.
template <bool mixed, class T, class L, class U, class Take>
inline void tangent(const ElementState<T>& e, const L& law, const BodyOf<U>& body, const Coefficients& c,
                    const std::type_identity_t<PointPrestress<T>>& prestress, ElementVector<T>& r, Take&& take) {
  const T rest_mass = T(body.density) * stress_free_volume(e, prestress);
  detail::start(e, rest_mass, r);
  detail::PointTangent<T> tangents[points];
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_four_points[q];
    const wall::ElementState<T> s = at_point(e, q, prestress);
    const Kinematics<T> k = kinematics(s);
    const auto& here = detail::law_at(law, q);
    const auto body_here = body.at_point(q);
    const auto isotropic = detail::isotropic_stress<mixed>(s, k.J, here, body_here);
    fe::ElementVector<T> force;
    detail::point_tangent(s, k, here, isotropic.pi, isotropic.kappa, c.displacement, prestress.stress_of(q), force,
                          tangents[q].stiffness);
    detail::spread(force, point, r);
    if constexpr (mixed) {
      detail::add_constraint(s, k.J, point, body_here, c.constraint, r);
      for (int a = 0; a < fe::nodes; ++a) tangents[q].dilation[a] = (s.reference.volume * k.J) * k.dN_x[a];
      tangents[q].spring = T(c.constraint) * T(body_here.volumetric.compressibility()) * s.reference.volume;
      tangents[q].push = isotropic.pressure;
      tangents[q].slope = T(c.constraint * c.displacement) * body.volumetric.unit_stiffness(k.J);
    }
  }
  const T mass = T(c.acceleration) * rest_mass;
  for (int a = 0; a < nodes; ++a) {
    TangentRow<T> row;
    detail::motion_of_row(tangents, a, mass, row);
    if constexpr (mixed) detail::pressure_of_row(tangents, a, row);
    take(a, row);
  }
}

}  // namespace tunica::wall::quadratic
