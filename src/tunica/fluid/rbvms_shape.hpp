// Shape derivative of the flow kernel: how the element residual (rbvms.hpp) changes when nodes of the element move.
//
// At the vessel wall the mesh moves with the unknown itself: a node there has the position x = ... + c_x v_{n+1} and
// the mesh velocity v^ = ... + c v_{n+1}, like the blood that sticks to it. With the node b moving along j,
//   dN_a,k -> - N_a,j N_b,k,   dV -> V N_b,j,   dL_ik = - L_ij N_b,k,   d(grad p)_k = - p,j N_b,k
// (L = grad v), from which all else follows by the chain rule. Held fixed are tau_M, tau_C and tau_B, as in
// rbvms_tangent.hpp.
#pragma once

#include "tunica/fluid/rbvms_tangent.hpp"

namespace tunica::fluid {

/// How a node that moves with the wall follows its unknown v_{n+1}.
struct MotionCoefficients {
  double position;       ///< c_x, d(position)/d(v_{n+1}) [s]
  double mesh_velocity;  ///< c, d(mesh velocity)/d(v_{n+1}) [-]
};

namespace detail {

/// Changes of the quantities at the points and of the integrals with one coordinate of one node.
template <class T>
struct ShapeVariation {
  Vec3<T> force[4];      ///< of the force at the points
  Mat3<T> stress;        ///< of the integral of the stress
  Vec3<T> sum_v_prime;   ///< of the sum of v' over the points
  T divergence, volume;  ///< of div v, and of the volume relative to it
};

/// For the unit motion of node `b` along axis `j`.
template <class Law, class T>
TUNICA_INLINE ShapeVariation<T> shape_variation(const Flow<T>& f, const Tau<T>& tau, const Integrals<T>& s, double rho,
                                                const MotionCoefficients& motion, int b, int j) {
  const T c_x(motion.position), c_v(motion.mesh_velocity), weight = T(0.25) * f.shape.volume;
  const Vec3<T>& dN = f.shape.dN[b];
  const Vec3<T> column{{f.gradient(0, j), f.gradient(1, j), f.gradient(2, j)}};
  const Vec3<T> along = c_x * dN;  // dL = - column (x) along
  ShapeVariation<T> d;
  d.volume = along[j];
  d.divergence = -dot(column, along);
  d.stress = zero_matrix<T>();
  d.sum_v_prime = zero_vector<T>();
  for (int q = 0; q < 4; ++q) {
    const T relative = c_v * T(q == b ? alpha : beta);  // a falls by this along j
    const Vec3<T> inertia = -(dot(f.a[q], along) + relative) * column;
    Vec3<T> v_prime = (tau.m[q] * f.grad_p[j]) * along;
    add(v_prime, T(-rho) * tau.m[q], inertia);
    const Vec3<T> convected = f.gradient * v_prime - dot(s.v_prime[q], along) * column;
    Vec3<T> minus_flux = T(-rho) * v_prime;
    minus_flux[j] += T(rho) * relative;
    add_outer(d.stress, v_prime, T(-rho) * (f.a[q] + s.v_prime[q]));
    add_outer(d.stress, s.v_prime[q], minus_flux);
    add_outer(d.stress, tau.b[q] * convected, s.v_prime[q]);
    add_outer(d.stress, tau.b[q] * s.convected[q], v_prime);
    d.force[q] = (weight * T(rho)) * (inertia + convected) + d.volume * s.force[q];
    d.sum_v_prime = d.sum_v_prime + v_prime;
  }
  T viscosity(0.0);
  if constexpr (!Law::constant)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        viscosity -= f.slope_over_rate * (f.gradient(i, k) + f.gradient(k, i)) * column[i] * along[k];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      d.stress(i, k) = weight * d.stress(i, k) + d.volume * s.stress(i, k) +
                       f.shape.volume * (viscosity * (f.gradient(i, k) + f.gradient(k, i)) -
                                         f.mu * (column[i] * along[k] + column[k] * along[i]));
  for (int i = 0; i < 3; ++i) d.stress(i, i) += weight * s.sum_tau_c * d.divergence;
  return d;
}

}  // namespace detail

/// Adds to k[a][b][i][j] the derivative by the motion of the nodes b that follow the wall: moves[b] = 1, else 0.
template <class Law, class T>
TUNICA_INLINE void add_shape_tangent(const Flow<T>& f, const Tau<T>& tau, double rho, const MotionCoefficients& motion,
                                     const T (&moves)[fe::nodes], fe::ElementMatrix<T>& k) {
  const Integrals<T> s = integrals(f, tau, rho);
  const T weight = T(0.25) * f.shape.volume;
  const Vec3<T> sum_v_prime = detail::sum4(s.v_prime);
  for (int b = 0; b < fe::nodes; ++b) {
    const Vec3<T> along = T(motion.position) * f.shape.dN[b];
    const Vec3<T> pulled = s.stress * along;
    const T pulled_v = weight * dot(along, sum_v_prime);
    for (int j = 0; j < 3; ++j) {
      const auto d = detail::shape_variation<Law>(f, tau, s, rho, motion, b, j);
      const Vec3<T> sum_force = detail::sum4(d.force);
      for (int a = 0; a < fe::nodes; ++a) {
        const Vec3<T>& dN = f.shape.dN[a];
        const Vec3<T> row = detail::blend(sum_force, d.force[a]) + d.stress * dN - dN[j] * pulled;
        for (int i = 0; i < 3; ++i) k.k[a][b][i][j] += moves[b] * row[i];
        const T continuity =
            weight * (d.divergence - dot(dN, d.sum_v_prime) + d.volume * (f.divergence - dot(dN, sum_v_prime)));
        k.k[a][b][3][j] += moves[b] * (continuity + dN[j] * pulled_v);
      }
    }
  }
}

/// Residual and tangent of an element some of whose nodes move with the wall; see tangent() and add_shape_tangent().
template <class T, class Law>
inline void tangent_beside_wall(const ElementState<T>& state, const TimeCoefficients& time,
                                const Parameters& parameters, const Law& law, const MotionCoefficients& motion,
                                const T (&moves)[fe::nodes], fe::ElementVector<T>& r, fe::ElementMatrix<T>& k) {
  const Flow<T> f = evaluate(state, law);
  const Tau<T> tau = stabilisation(f, time.dt, parameters);
  residual_with(f, tau, parameters.density, r);
  tangent_with<Law>(f, tau, time, parameters.density, k);
  add_shape_tangent<Law>(f, tau, parameters.density, motion, moves, k);
}

}  // namespace tunica::fluid
