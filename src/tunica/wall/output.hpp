// Quantities for output and energy balances: energies of an element, Cauchy stress and its invariants.
#pragma once

#include "tunica/wall/element.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::wall {

/// Kinetic energy of an element [J] with the consistent mass, from nodal velocities [m/s].
template <class T>
TUNICA_INLINE T kinetic_energy(const T& volume, const Vec3<T> (&velocity)[fe::nodes], double density) {
  Vec3<T> sum = velocity[0] + velocity[1] + velocity[2] + velocity[3];
  T squares = dot(sum, sum);
  for (const Vec3<T>& v : velocity) squares += dot(v, v);
  return T(density / 40.0) * volume * squares;
}

namespace detail {

/// Psi(C_bar) + Psi_u(C) [Pa].
template <class T, class L>
TUNICA_INLINE T strain_energy_density(const Kinematics<T>& k, const L& law) {
  T psi = law.energy(k.C_bar);
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) psi += law.unsplit_energy(right_cauchy_green(k.F));
  return psi;
}

}  // namespace detail

/// Stored energy of a displacement element [J]: V (Psi + K G(J)).
template <class T, class L>
TUNICA_INLINE T displacement_strain_energy(const ElementState<T>& e, const L& law, const Body& body) {
  const Kinematics<T> k = kinematics(e);
  const T volumetric = T(body.volumetric.bulk_modulus) * body.volumetric.unit_energy(k.J);
  return e.reference.volume * (detail::strain_energy_density(k, law) + volumetric);
}

/// Stored energy of a mixed element [J]: V Psi + integral of p^2 / (2 K) + tau_u/2 |grad_X p|^2. The volumetric
/// part is exact for the quadratic energy and to first order in p/K for the others; it vanishes when incompressible.
/// The last term is what the stabilisation stores, of order h^2; without it the energy balance would not close.
template <class T, class L>
TUNICA_INLINE T mixed_strain_energy(const ElementState<T>& e, const L& law, const Body& body) {
  const Kinematics<T> k = kinematics(e);
  const T sum = e.pressure[0] + e.pressure[1] + e.pressure[2] + e.pressure[3];
  T squares = sum * sum;
  for (const T& p : e.pressure) squares += p * p;
  const Vec3<T> gradient = pressure_gradient(e);
  const T subscale = T(0.5) * subscale_compliance(e, law, body) * dot(gradient, gradient);
  return e.reference.volume *
         (detail::strain_energy_density(k, law) + T(body.volumetric.compressibility() / 40.0) * squares + subscale);
}

namespace detail {

/// F S F^T / J.
template <class T>
TUNICA_INLINE Symmetric<T> push_forward(const Mat3<T>& F, const Symmetric<T>& S, const T& J) {
  const Mat3<T> FS = F * full(S);
  const T inverse_J = T(1.0) / J;
  Symmetric<T> sigma;
  for (int n = 0; n < voigt_size; ++n) {
    const int i = voigt_row[n], j = voigt_column[n];
    sigma[n] = inverse_J * (FS(i, 0) * F(j, 0) + FS(i, 1) * F(j, 1) + FS(i, 2) * F(j, 2));
  }
  return sigma;
}

/// sigma = [F (S' + S_u) F^T + (pi - theta) I] / J with S' = J^(-2/3) S_bar, (1.5) pushed forward.
template <class T, class L>
TUNICA_INLINE Symmetric<T> cauchy(const Kinematics<T>& k, const L& law, const T& pi) {
  const Symmetric<T> S_bar = stress(law, k.C_bar);
  Symmetric<T> S = k.scale * S_bar;
  if constexpr (can_be_unsplit<L>)
    if (law.has_unsplit_part()) S = S + law.unsplit_stress(right_cauchy_green(k.F));
  Symmetric<T> sigma = push_forward(k.F, S, k.J);
  const T isotropic = (pi - T(1.0 / 3.0) * double_dot(S_bar, k.C_bar)) / k.J;
  for (int n = 0; n < 3; ++n) sigma[n] += isotropic;
  return sigma;
}

}  // namespace detail

/// Cauchy stress of a displacement element [Pa], global axes, Voigt 11 22 33 12 23 13.
template <class T, class L>
TUNICA_INLINE Symmetric<T> displacement_cauchy_stress(const ElementState<T>& e, const L& law, const Body& body) {
  const Kinematics<T> k = kinematics(e);
  const T pi = T(body.volumetric.bulk_modulus) * k.J * body.volumetric.unit_pressure(k.J);
  return detail::cauchy(k, law, pi);
}

/// Cauchy stress of a mixed element with its mean pressure [Pa], global axes, Voigt 11 22 33 12 23 13.
template <class T, class L>
TUNICA_INLINE Symmetric<T> mixed_cauchy_stress(const ElementState<T>& e, const L& law) {
  const Kinematics<T> k = kinematics(e);
  return detail::cauchy(k, law, T(-k.J * detail::mean_pressure(e)));
}

/// What the prestress S0 [Pa] adds to the Cauchy stress [Pa].
template <class T>
TUNICA_INLINE Symmetric<T> prestress_cauchy_stress(const ElementState<T>& e, const Symmetric<T>& S0) {
  const Mat3<T> F = deformation_gradient(e);
  return detail::push_forward(F, S0, determinant(F));
}

/// Cauchy stress along a fibre, m.sigma.m [Pa]: m is the direction M that the fibre has in the axes of the material,
/// carried along by the deformation gradient F.
inline double fibre_stress(const Mat3<double>& F, const Symmetric<double>& sigma, const Vec3<double>& M) {
  const Vec3<double> m = F * M;
  return dot(m, full(sigma) * m) / dot(m, m);
}

/// von Mises equivalent stress [Pa].
template <class T>
TUNICA_INLINE T von_mises(const Symmetric<T>& s) {
  const T a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return sqrt(T(0.5) * (a * a + b * b + c * c) + T(3.0) * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Principal stresses [Pa], largest first (Smith 1961, trigonometric solution).
Vec3<double> principal_stresses(const Symmetric<double>& s);

}  // namespace tunica::wall
