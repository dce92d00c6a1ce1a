// Flow on a moving quadratic tetrahedron: quadratic velocity, linear pressure (Taylor & Hood 1973), streamline
// stabilisation of fluctuations (docs/theory.md, eqs 2.5, 2.6).
//
// Find (v, p) so that for all (w, q), with a = v - v^ the velocity relative to the mesh,
//   (w, rho (v. + a.grad v + 1/2 (div v) v)) + (grad w, 2 mu eps - p I) + (q, div v)
//   + sum_e (tau_M rho^2 b.grad w, b.grad v - P) + (tau_C div w, div v) = boundary terms,
//   tau_M = theta [rho sqrt(L^2 + s^2 tr G / 3 + (2 c_M)^2 mean_e |v.|^2 / s^2)]^-1,   s^2 = mean_e |b|^2 + (U / 5)^2,
//   tau_C = kappa rho sqrt(L^2 + mean_e |b|^2 tr G / 3) / tr G,   L^2 = mean_e b.G b + c_I (mu / rho)^2 G:G,
// with b = a, v. and P of the start of the step, P the L2 projection of b.grad v onto continuous quadratic functions
// (orthogonal subscales, Codina 2002; coupling/convection.hpp): what the mesh resolves of convection loses nothing.
//
// The pair satisfies the inf-sup condition, so no subscale carries mass: div v = 0 holds against every linear q. The
// term with 1/2 (div v) keeps convection from making energy where div v does not vanish in points (Temam 1968).
//
// tau_M does not know the time step: what a steady flow loses must not depend on it. In its place stand the times in
// which blood crosses the element and in which its velocity changes; a fifth of the speed U of the whole flow keeps
// tau_M smooth where blood stagnates; tau_C knows only the flow in the element, or it would be the largest friction of
// a false lumen where blood hardly moves. As b is known, the stabilisation is linear in the unknowns: with b = a
// Newton's method fails when a flow starts at once. It holds no rate: with that of the complete residual the equations
// lose their definiteness where pressure drives blood in, at steps far below tau_M.
//
// tau_C makes the velocity robust against the pressure: that of a jet, rho |v|^2 / 2, is far from linear in an element,
// and what linear pressure cannot balance drives v apart, by an error over mu without tau_C and over tau_C with it
// (Olshanskii et al. 2009).
//
// Corners alone move the mesh: positions and v^ are linear.
//
// All functions are templated on T = double, Dual (derivative checks) or Pack (one element per lane).
#pragma once

#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/fluid/rbvms_shape.hpp"

namespace tunica::fluid::taylor_hood {

inline constexpr int nodes = fe::quadratic_nodes;
inline constexpr int points = 14;

/// theta of tau_M: convection sees the length h / (2 p) of an element of order p = 2, and G stands for h.
inline constexpr double tau_m_factor = 0.25;

/// kappa of tau_C: 1.5 raises the pressure loss of a jet through an orifice by 3 (six elements across) and 8 % (three).
inline constexpr double tau_c_factor = 0.3;

/// What the kernel needs to know of an element.
template <class T>
struct ElementState {
  Vec3<T> position[4];          ///< of the corners at t_{n+alpha_f} [m]
  Vec3<T> velocity[nodes];      ///< v at t_{n+alpha_f} [m/s]
  Vec3<T> acceleration[nodes];  ///< dv/dt at the moving mesh node, at t_{n+alpha_m} [m/s^2]
  Vec3<T> mesh_velocity[4];     ///< v^ of the corners at t_{n+alpha_f} [m/s]
  Vec3<T> stream[nodes];        ///< b: velocity relative to the mesh at t_n [m/s]
  T rate_squared[nodes];        ///< |dv/dt|^2 at t_n [m^2/s^4]
  Vec3<T> convection[nodes];    ///< P: resolved part of b.grad v at t_n [m/s^2]
  T pressure[4];                ///< p at t_{n+alpha_f} [Pa]
};

/// Step size and unknowns as in rbvms.hpp, and the speed of the flow.
struct TimeCoefficients {
  double acceleration;  ///< d(acceleration)/d(v_{n+1}) [1/s]
  double velocity;      ///< d(velocity)/d(v_{n+1}) [-]
  double speed;         ///< U: largest speed of the flow at the start of the step [m/s]
};

/// Residual of an element: momentum of all nodes [N], continuity of the corners [m^3/s].
template <class T>
struct ElementVector {
  Vec3<T> momentum[nodes];
  T continuity[4];
};

/// One row of the tangent: what the node `a` of the residual feels of every column.
template <class T>
struct TangentRow {
  Mat3<T> velocity[nodes];    ///< d momentum / d v
  Vec3<T> pressure[4];        ///< d momentum / d p
  Vec3<T> continuity[nodes];  ///< d continuity / d v; corners only
};

/// What does not depend on the row, once for each element.
template <class T>
struct Flow {
  Vec3<T> g[4];  ///< gradients of the barycentric coordinates [1/m]
  T volume;      ///< m^3
  T gg[4][4];    ///< g_a . g_b
  T trace_g;
  T common;  ///< part of (theta / (rho tau_M))^2 without b.G b [1/s^2]
  T local;   ///< the same of tau_C: without the speed of the whole flow and the rate [1/s^2]
  T mu;      ///< viscosity at the centroid [Pa s]
};

/// At one point of the rule.
template <class T>
struct PointFlow {
  Vec3<T> dN[nodes];
  Mat3<T> gradient;  ///< v_i,j
  Vec3<T> a, v;      ///< relative and absolute velocity
  Vec3<T> inertia;   ///< v. + a.grad v
  Vec3<T> b;         ///< direction of the stabilisation [m/s]
  Vec3<T> along;     ///< b.grad v [m/s^2]
  Vec3<T> subscale;  ///< b.grad v - P [m/s^2]
  T divergence, pressure, mu, weight;
};

template <class T, class Law>
TUNICA_INLINE Flow<T> evaluate(const ElementState<T>& s, const TimeCoefficients& time, const Parameters& parameters,
                               const Law& law) {
  Flow<T> f;
  const auto shape = fe::gradients(s.position);
  f.volume = shape.volume;
  for (int a = 0; a < 4; ++a) f.g[a] = shape.dN[a];
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) f.gg[a][b] = dot(f.g[a], f.g[b]);
  // Mean gradient (at the centroid) for the viscosity inside the stabilisation.
  Mat3<T> mean = fluid::detail::zero_matrix<T>();  // corners have no gradient at the centroid
  for (int b = 4; b < nodes; ++b)
    fluid::detail::add_outer(mean, s.velocity[b], f.g[fe::gradient_of[b][0]] + f.g[fe::gradient_of[b][1]]);
  f.mu = law.viscosity(shear_rate(mean));
  T g_g(0.0), squares(0.0), rates(0.0);
  for (int k = 1; k < 4; ++k)
    for (int l = 1; l < 4; ++l) g_g += f.gg[k][l] * f.gg[k][l];
  for (int b = 0; b < nodes; ++b) {
    squares += dot(s.stream[b], s.stream[b]);
    rates += s.rate_squared[b];
  }
  const T nu = f.mu * T(1.0 / parameters.density);
  const T floor(0.04 * time.speed * time.speed + 1e-12);
  const T speed = T(1.0 / nodes) * squares + floor;
  const T rate = T(4.0 * parameters.c_m * parameters.c_m / nodes) * rates / speed;
  f.trace_g = f.gg[1][1] + f.gg[2][2] + f.gg[3][3];
  f.local = T(1.0 / (3.0 * nodes)) * f.trace_g * squares + T(parameters.c_i) * nu * nu * g_g;
  f.common = f.local + T(1.0 / 3.0) * f.trace_g * floor + rate;
  return f;
}

template <class T, class Law>
TUNICA_INLINE PointFlow<T> at_point(const ElementState<T>& s, const Flow<T>& f, const fe::QuadraticPoint& point,
                                    const Law& law) {
  PointFlow<T> p;
  p.weight = T(point.weight) * f.volume;
  p.gradient = fluid::detail::zero_matrix<T>();
  p.v = p.b = fluid::detail::zero_vector<T>();
  Vec3<T> rate = fluid::detail::zero_vector<T>();
  for (int b = 0; b < nodes; ++b) {
    p.dN[b] = fe::quadratic_gradient(f.g, point, b);
    fluid::detail::add_outer(p.gradient, s.velocity[b], p.dN[b]);
    fluid::detail::add(p.v, T(point.N[b]), s.velocity[b]);
    fluid::detail::add(p.b, T(point.N[b]), s.stream[b]);
    fluid::detail::add(rate, T(point.N[b]), s.acceleration[b]);
  }
  p.a = p.v;
  p.pressure = T(0.0);
  for (int b = 0; b < 4; ++b) {
    fluid::detail::add(p.a, T(-point.barycentric[b]), s.mesh_velocity[b]);
    p.pressure += T(point.barycentric[b]) * s.pressure[b];
  }
  p.inertia = rate + p.gradient * p.a;
  p.divergence = trace(p.gradient);
  p.mu = law.viscosity(shear_rate(p.gradient));
  p.along = p.subscale = p.gradient * p.b;
  for (int b = 0; b < nodes; ++b) fluid::detail::add(p.subscale, T(-point.N[b]), s.convection[b]);
  return p;
}

/// All points, and what they share of the stabilisation.
template <class T>
struct PointFlows {
  PointFlow<T> at[points];
  T tau_m;  ///< [s m^3/kg]
  T tau_c;  ///< [Pa s]
};

template <class T, class Law>
TUNICA_INLINE void at_points(const ElementState<T>& s, const Flow<T>& f, const Parameters& parameters, const Law& law,
                             PointFlows<T>& flows) {
  T metric(0.0);
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_fourteen_points[q];
    PointFlow<T>& p = flows.at[q] = at_point(s, f, point, law);
    for (int k = 1; k < 4; ++k) {
      const T along = dot(f.g[k], p.b);
      metric += T(point.weight) * along * along;
    }
  }
  flows.tau_m = T(tau_m_factor / parameters.density) / sqrt(f.common + metric + T(1e-12));
  flows.tau_c = T(tau_c_factor * parameters.density) * sqrt(f.local + metric + T(1e-12)) / f.trace_g;
}

/// Integrals of one point, added to the residual.
template <class T>
TUNICA_INLINE void add_residual(const PointFlows<T>& flows, int q, double rho, ElementVector<T>& r) {
  const PointFlow<T>& p = flows.at[q];
  const auto& point = fe::quadratic_fourteen_points[q];
  Vec3<T> force = T(rho) * p.inertia;  // with N_a
  fluid::detail::add(force, T(0.5 * rho) * p.divergence, p.v);
  for (int i = 0; i < 3; ++i) force[i] = p.weight * force[i];
  Mat3<T> stress;  // with grad N_a
  const Vec3<T> stream = (p.weight * T(rho * rho) * flows.tau_m) * p.b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress(i, j) = p.weight * p.mu * (p.gradient(i, j) + p.gradient(j, i)) + p.subscale[i] * stream[j];
  for (int i = 0; i < 3; ++i) stress(i, i) += p.weight * (flows.tau_c * p.divergence - p.pressure);
  for (int a = 0; a < nodes; ++a) {
    fluid::detail::add(r.momentum[a], T(point.N[a]), force);
    r.momentum[a] = r.momentum[a] + stress * p.dN[a];
  }
  for (int a = 0; a < 4; ++a) r.continuity[a] += p.weight * p.divergence * T(point.barycentric[a]);
}

template <class T>
TUNICA_INLINE void set_zero(ElementVector<T>& r) {
  for (auto& m : r.momentum) m = fluid::detail::zero_vector<T>();
  for (auto& c : r.continuity) c = T(0.0);
}

/// Residual of an element.
template <class T, class Law>
inline void residual(const ElementState<T>& state, const TimeCoefficients& time, const Parameters& parameters,
                     const Law& law, ElementVector<T>& r) {
  set_zero(r);
  const Flow<T> f = evaluate(state, time, parameters, law);
  PointFlows<T> flows;
  at_points(state, f, parameters, law, flows);
  for (int q = 0; q < points; ++q) add_residual(flows, q, parameters.density, r);
}

/// Energy of an element [J] and the power that leaves its resolved flow [W]; the numerical one may be negative in an
/// element: of the whole lumen it is the part of b.grad v that the mesh does not resolve.
template <class T>
struct Energy {
  T volume, kinetic, viscous, numerical;
};

template <class T, class Law>
inline Energy<T> energy(const ElementState<T>& state, const TimeCoefficients& time, const Parameters& parameters,
                        const Law& law) {
  const Flow<T> f = evaluate(state, time, parameters, law);
  Energy<T> sum{f.volume, T(0.0), T(0.0), T(0.0)};
  PointFlows<T> flows;
  at_points(state, f, parameters, law, flows);
  for (const PointFlow<T>& p : flows.at) {
    const T gamma = shear_rate(p.gradient);
    sum.kinetic += T(0.5 * parameters.density) * p.weight * dot(p.v, p.v);
    sum.viscous += p.weight * p.mu * gamma * gamma;
    sum.numerical += p.weight * (T(parameters.density * parameters.density) * flows.tau_m * dot(p.subscale, p.along) +
                                 flows.tau_c * p.divergence * p.divergence);
  }
  return sum;
}

/// How the residual changes with the unknowns of those corners that move with the wall (as in rbvms_shape.hpp).
template <class T>
struct ShapeTangent {
  Mat3<T> momentum[nodes][4];
  Vec3<T> continuity[4][4];
};

/// With the corner b moving along j, dN_a,k -> - N_a,j l_b,k, dV -> V l_b,j, d(grad v)_ik = - v_i,j l_b,k, and v^
/// changes by l_b along j. Held fixed are tau_M, tau_C, b and P. `r` is the residual of the element, moves[b] = 1 where
/// b follows the wall, else 0.
template <class Law, class T>
inline void shape_tangent(const Flow<T>& f, const PointFlows<T>& flows, const Law& law, double rho,
                          const MotionCoefficients& motion, const T (&moves)[4], const ElementVector<T>& r,
                          ShapeTangent<T>& k) {
  for (int b = 0; b < 4; ++b) {
    const Vec3<T> along = (T(motion.position) * moves[b]) * f.g[b];
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) k.momentum[a][b](i, j) = along[j] * r.momentum[a][i];
    for (int a = 0; a < 4; ++a) k.continuity[a][b] = r.continuity[a] * along;
    for (int q = 0; q < points; ++q) {
      const auto& point = fe::quadratic_fourteen_points[q];
      const PointFlow<T>& p = flows.at[q];
      const T relative = T(motion.mesh_velocity * point.barycentric[b]) * moves[b] + dot(p.a, along);
      const Vec3<T> stream = (p.weight * T(rho * rho) * flows.tau_m) * p.b;
      const T b_along = dot(p.b, along);
      const Mat3<T> twice_strain = p.gradient + transpose(p.gradient);
      Vec3<T> pulled;  // stress . along
      const T pressure = flows.tau_c * p.divergence - p.pressure, stream_along = dot(stream, along);
      for (int i = 0; i < 3; ++i) {
        pulled[i] = p.subscale[i] * stream_along + p.weight * pressure * along[i];
        for (int l = 0; l < 3; ++l) pulled[i] += p.weight * p.mu * twice_strain(i, l) * along[l];
      }
      for (int j = 0; j < 3; ++j) {
        const Vec3<T> column{{p.gradient(0, j), p.gradient(1, j), p.gradient(2, j)}};
        const T divergence = -dot(column, along);
        const Vec3<T> inertia = (-relative) * column;
        const Vec3<T> subscale = (-b_along) * column;
        Vec3<T> force = (p.weight * T(rho)) * inertia;
        fluid::detail::add(force, T(0.5 * rho) * p.weight * divergence, p.v);
        T slope(0.0);
        if constexpr (!Law::constant) {
          const T gamma = shear_rate(p.gradient);
          slope = -(law.slope(gamma) / gamma) * dot(twice_strain * along, column);
        }
        Mat3<T> stress;
        for (int i = 0; i < 3; ++i)
          for (int l = 0; l < 3; ++l)
            stress(i, l) =
                p.weight * (slope * twice_strain(i, l) - p.mu * (column[i] * along[l] + column[l] * along[i])) +
                subscale[i] * stream[l];
        for (int i = 0; i < 3; ++i) stress(i, i) += p.weight * flows.tau_c * divergence;
        for (int a = 0; a < nodes; ++a) {
          const Vec3<T> d = stress * p.dN[a];
          for (int i = 0; i < 3; ++i)
            k.momentum[a][b](i, j) += T(point.N[a]) * force[i] + d[i] - p.dN[a][j] * pulled[i];
        }
        for (int a = 0; a < 4; ++a) k.continuity[a][b][j] += p.weight * T(point.barycentric[a]) * divergence;
      }
    }
  }
}

/// Residual and tangent with respect to (v_{n+1}, p), exact but for the viscosity inside tau_M. `row(a,
/// TangentRow)` takes the rows one after another, so that a row stays in the cache. `moves` (or null): see
/// shape_tangent.
template <class T, class Law, class TakeRow>
inline void tangent(const ElementState<T>& state, const TimeCoefficients& time, const Parameters& parameters,
                    const Law& law, const MotionCoefficients& motion, const T (*moves)[4], ElementVector<T>& r,
                    TakeRow&& take_row) {
  const double rho = parameters.density;
  set_zero(r);
  const Flow<T> f = evaluate(state, time, parameters, law);
  PointFlows<T> flows;
  at_points(state, f, parameters, law, flows);
  const auto& at = flows.at;
  T transport[points][nodes];  // m N_b + c a.grad N_b
  T stream[points][nodes];     // b.grad N_b
  const T c(time.velocity), m(time.acceleration);
  for (int q = 0; q < points; ++q) {
    const auto& point = fe::quadratic_fourteen_points[q];
    add_residual(flows, q, rho, r);
    for (int b = 0; b < nodes; ++b) {
      const T along = dot(at[q].a, at[q].dN[b]);
      transport[q][b] = m * T(point.N[b]) + c * along;
      stream[q][b] = dot(at[q].b, at[q].dN[b]);
    }
  }
  ShapeTangent<T> shape;
  if (moves != nullptr) shape_tangent(f, flows, law, rho, motion, *moves, r, shape);
  for (int a = 0; a < nodes; ++a) {
    TangentRow<T> row;
    for (int b = 0; b < nodes; ++b) row.velocity[b] = fluid::detail::zero_matrix<T>();
    for (int b = 0; b < 4; ++b) row.pressure[b] = fluid::detail::zero_vector<T>();
    for (int b = 0; b < nodes; ++b) row.continuity[b] = fluid::detail::zero_vector<T>();
    T isotropic[nodes];
    for (int b = 0; b < nodes; ++b) isotropic[b] = T(0.0);
    for (int q = 0; q < points; ++q) {
      const auto& point = fe::quadratic_fourteen_points[q];
      const PointFlow<T>& p = at[q];
      const T test = p.weight * T(rho * point.N[a]);
      const T streamline = (c * T(rho * rho) * flows.tau_m * p.weight) * stream[q][a];
      const T half = T(0.5) * c * test * p.divergence;
      Mat3<T> by_n = (c * test) * p.gradient;  // stands with N_b
      const T viscous = c * p.mu * p.weight;
      const Vec3<T> mu_a = viscous * p.dN[a], div_v = (T(0.5) * c * test) * p.v;
      if constexpr (!Law::constant) {
        const T gamma = shear_rate(p.gradient);
        const Mat3<T> twice_strain = p.gradient + transpose(p.gradient);
        const Vec3<T> strain_a = (c * p.weight * law.slope(gamma) / gamma) * (twice_strain * p.dN[a]);
        for (int b = 0; b < nodes; ++b) fluid::detail::add_outer(row.velocity[b], strain_a, twice_strain * p.dN[b]);
      }
      for (int b = 0; b < nodes; ++b) {
        isotropic[b] += test * transport[q][b] + streamline * stream[q][b] + half * T(point.N[b]) + dot(mu_a, p.dN[b]);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            row.velocity[b](i, j) += T(point.N[b]) * by_n(i, j) + mu_a[j] * p.dN[b][i] +
                                     (div_v[i] + c * flows.tau_c * p.weight * p.dN[a][i]) * p.dN[b][j];
      }
      for (int b = 0; b < 4; ++b) fluid::detail::add(row.pressure[b], -p.weight * T(point.barycentric[b]), p.dN[a]);
      if (a < 4)
        for (int b = 0; b < nodes; ++b)
          fluid::detail::add(row.continuity[b], c * p.weight * T(point.barycentric[a]), p.dN[b]);
    }
    for (int b = 0; b < nodes; ++b)
      for (int i = 0; i < 3; ++i) row.velocity[b](i, i) += isotropic[b];
    if (moves != nullptr)
      for (int b = 0; b < 4; ++b) {
        row.velocity[b] = row.velocity[b] + shape.momentum[a][b];
        if (a < 4) row.continuity[b] = row.continuity[b] + shape.continuity[a][b];
      }
    take_row(a, row);
  }
}

}  // namespace tunica::fluid::taylor_hood
