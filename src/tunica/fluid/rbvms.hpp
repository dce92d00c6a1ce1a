// Residual-based variational multiscale flow on a moving linear tetrahedron (Bazilevs et al. 2007; eqs 2.1-2.4).
//
// Find (v, p) so that for all (w, q), with a = v - v^ the velocity relative to the mesh and A = a + v',
//   (w, rho (v. + A.grad v)) + (grad w, 2 mu eps - rho v' (x) A + tau_B (v'.grad v) (x) v' - (p + p') I)
//   + (q, div v) - (grad q, v') = boundary terms.
//
// Order of the indices. (grad w, S) is the integral of w_i,j S_ij, and (x (x) y)_ij = x_i y_j. The resolved and the
// unresolved velocity together carry the momentum rho (v + v')_i through space with the velocity A_j, so the flux of
// unresolved momentum is rho v'_i A_j and moves onto w by parts (div A = 0) as - w_i,j rho v'_i A_j. Its part
// - rho (a.grad w).v' = + rho tau_M (a.grad w).r_M is the streamline stabilisation (SUPG), which has to weigh along a:
// the transposed order, v'_j A_i, would weigh along v' and not dissipate. Likewise tau_B (v'.grad w).(v'.grad v) is
// dissipative, >= 0 for w = v, only in the order written.
//
// The gradients of a linear tetrahedron are constant. Hence r_M has no viscous part, and every integrand depends on the
// point only through v., a, v' and the shape functions. The four-point rule is exact for all but the products with the
// stabilisation parameters. At its point q, N_b takes just two values, alpha for b = q and beta otherwise, so that
// sum_q X(q) N_b(q) = beta sum_q X(q) + (alpha - beta) X(b): all shape-function sums below cost one multiplication.
//
// All functions are templated on T = double, Dual (derivative checks) or Pack (one element per lane).
#pragma once

#include "tunica/fe/tetrahedron.hpp"
#include "tunica/fluid/parameters.hpp"

namespace tunica::fluid {

/// What the kernel needs to know of an element. Indices: node.
template <class T>
struct ElementState {
  Vec3<T> position[fe::nodes];       ///< at t_{n+alpha_f} [m]; the element must not be inverted (volume > 0)
  Vec3<T> velocity[fe::nodes];       ///< v at t_{n+alpha_f} [m/s]
  Vec3<T> acceleration[fe::nodes];   ///< dv/dt at the moving mesh node, at t_{n+alpha_m} [m/s^2]
  Vec3<T> mesh_velocity[fe::nodes];  ///< v^ at t_{n+alpha_f} [m/s]
  T pressure[fe::nodes];             ///< p at t_{n+alpha_f} [Pa]
};

/// Step size, and how the state depends on the unknowns (v_{n+1}, p_{n+alpha_f}) of Newton's method.
struct TimeCoefficients {
  double dt;            ///< step size in tau_M, eq (2.2) [s]; infinity for steady flow
  double acceleration;  ///< d(acceleration)/d(v_{n+1}) [1/s]: alpha_m / (gamma dt) for generalised-alpha
  double velocity;      ///< d(velocity)/d(v_{n+1}) [-]: alpha_f
  double speed = 0.0;   ///< largest speed of the flow at the start of the step [m/s]; quadratic elements alone
};

/// Resolved quantities: constant ones and those at the four points.
template <class T>
struct Flow {
  fe::Gradients<T> shape;  ///< gradients of the shape functions, volume
  Mat3<T> gradient;        ///< v_i,j [1/s]
  Vec3<T> grad_p;          ///< [Pa/m]
  T divergence;            ///< r_C [1/s]
  T mean_pressure;         ///< [Pa]
  T mu;                    ///< viscosity [Pa s]
  T slope_over_rate;       ///< (d mu / d gamma) / gamma [Pa s^3]; unset for laws of constant viscosity
  Vec3<T> a[4];            ///< velocity relative to the mesh [m/s]
  Vec3<T> inertia[4];      ///< v. + a.grad v [m/s^2]
};

/// Stabilisation parameters and unresolved scales at the four points, eqs (2.2), (2.3).
template <class T>
struct Tau {
  T m[4];  ///< tau_M [s m^3/kg]
  T c[4];  ///< tau_C [Pa s]
  T b[4];  ///< tau_B [kg s/m^3]
};

/// gamma = sqrt(2 eps:eps) [1/s]. Kept above 1e-10 1/s: far below any shear rate that matters, and it spares the
/// viscosity laws the case gamma = 0.
template <class T>
TUNICA_INLINE T shear_rate(const Mat3<T>& gradient) {
  T s(1e-20);
  for (int i = 0; i < 3; ++i) s += T(2.0) * gradient(i, i) * gradient(i, i);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const T shear = gradient(i, j) + gradient(j, i);
    s += shear * shear;
  }
  return sqrt(s);
}

namespace detail {

inline constexpr double alpha = fe::four_points[0].barycentric[0];
inline constexpr double beta = fe::four_points[0].barycentric[1];

constexpr bool point_belongs_to_node() {
  for (int q = 0; q < 4; ++q)
    for (int b = 0; b < 4; ++b)
      if (fe::four_points[q].barycentric[b] != (q == b ? alpha : beta) || fe::four_points[q].weight != 0.25)
        return false;
  return true;
}
static_assert(point_belongs_to_node(), "the kernel uses that point q is the one next to node q");

/// Adds s x.
template <class T>
TUNICA_INLINE void add(Vec3<T>& y, const T& s, const Vec3<T>& x) {
  for (int i = 0; i < 3; ++i) y[i] += s * x[i];
}
/// Adds x (x) y.
template <class T>
TUNICA_INLINE void add_outer(Mat3<T>& m, const Vec3<T>& x, const Vec3<T>& y) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) += x[i] * y[j];
}
template <class T>
TUNICA_INLINE Vec3<T> zero_vector() {
  return {{T(0.0), T(0.0), T(0.0)}};
}
template <class T>
TUNICA_INLINE Mat3<T> zero_matrix() {
  return {{{T(0.0), T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0)}}};
}
template <class T>
TUNICA_INLINE Vec3<T> sum4(const Vec3<T> (&x)[4]) {
  return (x[0] + x[1]) + (x[2] + x[3]);
}
template <class T>
TUNICA_INLINE T sum4(const T (&x)[4]) {
  return (x[0] + x[1]) + (x[2] + x[3]);
}
/// sum_q N_b(q) x(q) for one node b, given x and its sum; also the value at point b of a nodal field x.
template <class T>
TUNICA_INLINE Vec3<T> blend(const Vec3<T>& sum, const Vec3<T>& x) {
  Vec3<T> r;
  for (int i = 0; i < 3; ++i) r[i] = T(beta) * sum[i] + T(alpha - beta) * x[i];
  return r;
}
template <class T>
TUNICA_INLINE T blend(const T& sum, const T& x) {
  return T(beta) * sum + T(alpha - beta) * x;
}

}  // namespace detail

/// Resolved quantities of an element.
template <class T, class Law>
TUNICA_INLINE Flow<T> evaluate(const ElementState<T>& state, const Law& law) {
  Flow<T> f;
  f.shape = fe::gradients(state.position);
  f.gradient = detail::zero_matrix<T>();
  f.grad_p = detail::zero_vector<T>();
  for (int b = 0; b < 4; ++b) {
    detail::add_outer(f.gradient, state.velocity[b], f.shape.dN[b]);
    detail::add(f.grad_p, state.pressure[b], f.shape.dN[b]);
  }
  f.divergence = trace(f.gradient);
  f.mean_pressure = T(0.25) * detail::sum4(state.pressure);
  const T gamma = shear_rate(f.gradient);
  f.mu = law.viscosity(gamma);
  if constexpr (!Law::constant) f.slope_over_rate = law.slope(gamma) / gamma;

  Vec3<T> relative[4];
  for (int b = 0; b < 4; ++b) relative[b] = state.velocity[b] - state.mesh_velocity[b];
  const Vec3<T> sum_a = detail::sum4(relative), sum_acceleration = detail::sum4(state.acceleration);
  for (int q = 0; q < 4; ++q) {
    f.a[q] = detail::blend(sum_a, relative[q]);
    f.inertia[q] = detail::blend(sum_acceleration, state.acceleration[q]) + f.gradient * f.a[q];
  }
  return f;
}

/// r_M = rho (v. + a.grad v) + grad p at point q, eq (2.1).
template <class T>
TUNICA_INLINE Vec3<T> momentum_residual(const Flow<T>& f, double rho, int q) {
  Vec3<T> r = f.grad_p;
  detail::add(r, T(rho), f.inertia[q]);
  return r;
}

/// Stabilisation parameters, eqs (2.2), (2.3). G is the metric of the parent tetrahedron, one of whose corners is the
/// origin and the others are e1, e2, e3; it therefore depends on which: the first one, of `vms_classic` the last one as
/// in related codes. Where v' vanishes tau_B is bounded, so that the terms with it vanish too.
template <class T>
TUNICA_INLINE Tau<T> stabilisation(const Flow<T>& f, double dt, const Parameters& parameters) {
  const double rho = parameters.density;
  const bool classic = parameters.stabilisation == Stabilisation::vms_classic;
  Vec3<T> xi[3];  // gradients of the parent coordinates
  for (int k = 0; k < 3; ++k) xi[k] = classic ? f.shape.dN[k] : f.shape.dN[k + 1];
  const auto metric = [&xi](const Vec3<T>& x) {
    const T s0 = dot(xi[0], x), s1 = dot(xi[1], x), s2 = dot(xi[2], x);
    return s0 * s0 + s1 * s1 + s2 * s2;
  };
  // tr G = sum_k |xi_k|^2 and G:G = sum_kl (xi_k . xi_l)^2.
  const T g00 = dot(xi[0], xi[0]), g11 = dot(xi[1], xi[1]), g22 = dot(xi[2], xi[2]);
  const T g01 = dot(xi[0], xi[1]), g12 = dot(xi[1], xi[2]), g20 = dot(xi[2], xi[0]);
  const T trace_g = g00 + g11 + g22;
  const T g_g = g00 * g00 + g11 * g11 + g22 * g22 + T(2.0) * (g01 * g01 + g12 * g12 + g20 * g20);
  const T nu = f.mu * T(1.0 / rho);
  const T rate = T(4.0 * parameters.c_m * parameters.c_m / (dt * dt));
  const T diffusion = T(parameters.c_i) * nu * nu * g_g;
  const T rate_in_c = classic ? rate : T(0.0);
  const T rho_over_trace = T(rho) / trace_g;
  Tau<T> tau;
  for (int q = 0; q < 4; ++q) {
    const T flow = diffusion + metric(f.a[q]);
    tau.m[q] = T(1.0 / rho) / sqrt(rate + flow);
    tau.c[q] = sqrt(rate_in_c + flow) * rho_over_trace;
    const Vec3<T> v_prime = (-tau.m[q]) * momentum_residual(f, rho, q);
    tau.b[q] = T(rho) / sqrt(metric(v_prime) + T(1e-60));
  }
  return tau;
}

/// Integrals over the element that the residual is made of, for given stabilisation parameters.
template <class T>
struct Integrals {
  Vec3<T> v_prime[4];    ///< v' at the points [m/s]
  Vec3<T> convected[4];  ///< v'.grad v at the points [m/s^2]
  Vec3<T> force[4];      ///< rho (v. + A.grad v) at the points, times the weight [N]
  Mat3<T> stress;        ///< of what stands with grad w [N m]
  T sum_tau_c;           ///< sum of tau_C over the points [Pa s]
};

template <class T>
TUNICA_INLINE Integrals<T> integrals(const Flow<T>& f, const Tau<T>& tau, double rho) {
  Integrals<T> s;
  const T weight = T(0.25) * f.shape.volume;
  s.stress = detail::zero_matrix<T>();
  s.sum_tau_c = T(0.0);
  for (int q = 0; q < 4; ++q) {
    s.v_prime[q] = (-tau.m[q]) * momentum_residual(f, rho, q);
    s.convected[q] = f.gradient * s.v_prime[q];
    const Vec3<T> minus_flux = T(-rho) * (f.a[q] + s.v_prime[q]);
    detail::add_outer(s.stress, s.v_prime[q], minus_flux);
    detail::add_outer(s.stress, tau.b[q] * s.convected[q], s.v_prime[q]);
    s.force[q] = (weight * T(rho)) * (f.inertia[q] + s.convected[q]);
    s.sum_tau_c += tau.c[q];
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      s.stress(i, j) = weight * s.stress(i, j) + f.shape.volume * f.mu * (f.gradient(i, j) + f.gradient(j, i));
  const T pressure = f.shape.volume * f.mean_pressure - weight * s.sum_tau_c * f.divergence;  // p + p'
  for (int i = 0; i < 3; ++i) s.stress(i, i) -= pressure;
  return s;
}

/// Residual of eq (2.4) from them: r[a][0..2] momentum [N], r[a][3] continuity [m^3/s].
template <class T>
TUNICA_INLINE void residual_with(const Flow<T>& f, const Integrals<T>& s, fe::ElementVector<T>& r) {
  const T weight = T(0.25) * f.shape.volume;
  const Vec3<T> sum_force = detail::sum4(s.force), sum_v_prime = detail::sum4(s.v_prime);
  for (int a = 0; a < 4; ++a) {
    const Vec3<T> row = detail::blend(sum_force, s.force[a]) + s.stress * f.shape.dN[a];
    for (int i = 0; i < 3; ++i) r.r[a][i] = row[i];
    r.r[a][3] = weight * (f.divergence - dot(f.shape.dN[a], sum_v_prime));
  }
}

/// The same for given stabilisation parameters.
template <class T>
TUNICA_INLINE void residual_with(const Flow<T>& f, const Tau<T>& tau, double rho, fe::ElementVector<T>& r) {
  residual_with(f, integrals(f, tau, rho), r);
}

/// Residual of an element. `law` is the alternative that parameters.viscosity holds (visit the variant once, outside
/// the element loop).
template <class T, class Law>
inline void residual(const ElementState<T>& state, const TimeCoefficients& time, const Parameters& parameters,
                     const Law& law, fe::ElementVector<T>& r) {
  const Flow<T> f = evaluate(state, law);
  const Tau<T> tau = stabilisation(f, time.dt, parameters);
  residual_with(f, tau, parameters.density, r);
}

}  // namespace tunica::fluid
