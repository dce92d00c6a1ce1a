// What a wall law is, and stress and tangent from its energy.
//
// A law is a small struct of named parameters. Its specification is the energy
//     Psi = law.energy(C_bar)  [Pa],   C_bar = J^(-2/3) C,
// the part of the strain energy that depends on the isochoric right Cauchy-Green tensor, (1.1) without Psi_vol. The
// element kernels do the isochoric split (1.5), so a law never sees J. From the energy follow
//     S_bar  = 2 dPsi/dC_bar   and   CC_bar = 4 d2Psi/dC_bar dC_bar                                            [Pa]
// by dual numbers. A law may write them by hand for speed, in stress() and response(); the shared tests hold the two
// against each other. A law whose energy is linear in C_bar says so, and the kernels then skip CC_bar.
//
// A law may keep a part of its energy out of the isochoric split (Nolan et al. 2014): fibres that feel C itself, so
// that they do not resist a change of volume by a change of shape. Its energy then is Psi(C_bar) + Psi_u(C), with
//     Psi_u = law.unsplit_energy(C),   S_u = 2 dPsi_u/dC,   CC_u = 4 d2Psi_u/dC dC,
// written by hand in unsplit_stress() and unsplit_response(); law.has_unsplit_part() says whether there is one.
//
// Components refer to the axes in which the reference gradients of the element are given. A fibre law wants the
// element's fibre frame (e1 circumferential, e2 longitudinal, e3 radial): store the gradients in that frame and nothing
// has to be rotated, since F = dx/dX keeps global axes for x.
#pragma once

#include <concepts>

#include "tunica/base/dual.hpp"
#include "tunica/wall/symmetric.hpp"

namespace tunica::wall {

/// Stress S_bar and tangent CC_bar of a law at one C_bar.
template <class T>
struct Response {
  Symmetric<T> stress;
  SymmetricTangent<T> tangent;
};

template <class T>
TUNICA_INLINE Response<T> zero_response() {
  Response<T> r;
#pragma GCC unroll 6
  for (T& x : r.stress.v) x = T(0.0);
#pragma GCC unroll 21
  for (T& x : r.tangent.v) x = T(0.0);
  return r;
}

/// A law: its energy for every scalar type, and the shear modulus at rest [Pa], which scales the stabilisation.
template <class Law>
concept Material = requires(const Law& law, const Symmetric<double>& C_bar, const Symmetric<Pack<4>>& batch) {
  { law.energy(C_bar) } -> std::same_as<double>;
  { law.energy(batch) } -> std::same_as<Pack<4>>;
  { law.shear_modulus_at_rest() } -> std::convertible_to<double>;
};

/// Modulus that scales the stabilisation of the mixed element [Pa]: that at rest, unless the law knows the present one.
template <class Law>
TUNICA_INLINE auto stabilising_modulus(const Law& law) {
  if constexpr (requires { law.stabilising_modulus; })
    return law.stabilising_modulus;
  else
    return law.shear_modulus_at_rest();
}

/// True where the energy is linear in C_bar, so that CC_bar = 0.
template <class Law>
inline constexpr bool is_linear = requires {
  requires Law::linear;
};

/// True for laws that can have a part outside the isochoric split.
template <class Law>
inline constexpr bool can_be_unsplit = requires(const Law& law) {
  { law.has_unsplit_part() } -> std::same_as<bool>;
};

/// Has the law a part outside the isochoric split?
template <class Law>
inline bool has_unsplit_part(const Law& law) {
  if constexpr (can_be_unsplit<Law>)
    return law.has_unsplit_part();
  else
    return false;
}

/// dPsi/dC_IJ from the derivative with respect to the Voigt variable, which stands for two entries in shear.
inline constexpr double voigt_share[voigt_size] = {1.0, 1.0, 1.0, 0.5, 0.5, 0.5};

/// 2 dPsi/dC from the energy alone, a function of Symmetric<any scalar>.
template <class T, class Energy>
inline Symmetric<T> derived_stress(const Energy& energy, const Symmetric<T>& at) {
  using D = Dual<T, voigt_size>;
  Symmetric<D> C;
  for (int i = 0; i < voigt_size; ++i) C[i] = D::variable(at[i], i);
  const D psi = energy(C);
  Symmetric<T> S;
  for (int i = 0; i < voigt_size; ++i) S[i] = T(2.0 * voigt_share[i]) * psi.d[i];
  return S;
}

/// 2 dPsi/dC and 4 d2Psi/dC dC from the energy alone.
template <class T, class Energy>
inline Response<T> derived_response(const Energy& energy, const Symmetric<T>& at) {
  using D = Dual<T, voigt_size>;
  using DD = Dual<D, voigt_size>;
  Symmetric<DD> C;
  for (int i = 0; i < voigt_size; ++i) C[i] = DD::variable(D::variable(at[i], i), i);
  const DD psi = energy(C);
  Response<T> r;
  for (int i = 0; i < voigt_size; ++i) {
    r.stress[i] = T(2.0 * voigt_share[i]) * psi.value.d[i];
    for (int j = i; j < voigt_size; ++j) r.tangent(i, j) = T(4.0 * voigt_share[i] * voigt_share[j]) * psi.d[i].d[j];
  }
  return r;
}

/// S_bar [Pa]: by hand where the law has it, else derived.
template <class T, class Law>
TUNICA_INLINE Symmetric<T> stress(const Law& law, const Symmetric<T>& C_bar) {
  if constexpr (requires { law.stress(C_bar); })
    return law.stress(C_bar);
  else
    return derived_stress([&](const auto& C) { return law.energy(C); }, C_bar);
}

/// S_bar and CC_bar [Pa]: by hand where the law has it, else derived. Not for linear laws.
template <class T, class Law>
TUNICA_INLINE Response<T> response(const Law& law, const Symmetric<T>& C_bar) {
  if constexpr (requires { law.response(C_bar); })
    return law.response(C_bar);
  else
    return derived_response([&](const auto& C) { return law.energy(C); }, C_bar);
}

}  // namespace tunica::wall
