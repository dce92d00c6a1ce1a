// Energy of the flow in one element, for the energy balance and the checks of the stabilisation.
#pragma once

#include "tunica/fluid/rbvms.hpp"

namespace tunica::fluid {

/// Kinetic energy of the resolved velocity [J]; exact: the consistent mass matrix is rho vol / 20 (1 + delta_ab).
template <class T>
TUNICA_INLINE T kinetic_energy(const T& volume, const Vec3<T> (&velocity)[fe::nodes], double density) {
  const Vec3<T> sum = detail::sum4(velocity);
  T squares = dot(sum, sum);
  for (int a = 0; a < fe::nodes; ++a) squares += dot(velocity[a], velocity[a]);
  return T(density / 40.0) * volume * squares;
}

/// Power that viscosity turns into heat, integral of 2 mu eps:eps [W].
template <class T>
TUNICA_INLINE T viscous_dissipation(const Flow<T>& f) {
  const T gamma = shear_rate(f.gradient);
  return f.shape.volume * f.mu * gamma * gamma;
}

/// Power that the stabilisation takes out of the resolved flow: all terms of eq (2.4) with v' or p', tested with
/// w = v, q = p [W]. `velocity` are the nodal values. It is positive as a rule, but not term by term: v' also exchanges
/// energy with the resolved scales, which is its purpose.
template <class T>
TUNICA_INLINE T numerical_dissipation(const Flow<T>& f, const Tau<T>& tau, const Vec3<T> (&velocity)[fe::nodes],
                                      double density) {
  const Vec3<T> sum = detail::sum4(velocity);
  T power(0.0);
  for (int q = 0; q < 4; ++q) {
    const Vec3<T> v_prime = (-tau.m[q]) * momentum_residual(f, density, q), flux = f.a[q] + v_prime;
    const Vec3<T> convected = f.gradient * v_prime;
    power += T(density) * (dot(detail::blend(sum, velocity[q]), convected) - dot(v_prime, f.gradient * flux));
    power += tau.b[q] * dot(convected, convected) + tau.c[q] * f.divergence * f.divergence - dot(f.grad_p, v_prime);
  }
  return T(0.25) * f.shape.volume * power;
}

}  // namespace tunica::fluid
