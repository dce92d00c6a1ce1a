// A neo-Hookean matrix with fibres in it, (1.13). The fibres follow either C_bar, as in the original laws, or C
// (unsplit, Nolan et al. 2014).
#pragma once

#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

template <class Fibres>
struct FibreReinforced {
  double shear_modulus = 0.0;  ///< mu of the matrix [Pa]
  bool unsplit = false;        ///< do the fibres follow C?
  Fibres fibres;

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    const T matrix = T(0.5 * shear_modulus) * (trace(C_bar) - T(3.0));
    return unsplit ? matrix : matrix + fibres.energy(C_bar);
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C_bar) const {
    const T mu(shear_modulus), zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    if (!unsplit) S = fibres.stress(C_bar);
    for (int n = 0; n < 3; ++n) S[n] += mu;
    return S;
  }
  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C_bar) const {
    Response<T> r = unsplit ? zero_response<T>() : fibres.response(C_bar);
    for (int n = 0; n < 3; ++n) r.stress[n] += T(shear_modulus);
    return r;
  }

  bool has_unsplit_part() const { return unsplit; }
  template <class T>
  T unsplit_energy(const Symmetric<T>& C) const {
    return fibres.energy(C);
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> unsplit_stress(const Symmetric<T>& C) const {
    return fibres.stress(C);
  }
  template <class T>
  TUNICA_INLINE Response<T> unsplit_response(const Symmetric<T>& C) const {
    return fibres.response(C);
  }

  /// Of the matrix: fibres that bear no compression leave no more at rest.
  double shear_modulus_at_rest() const { return shear_modulus; }
};

}  // namespace tunica::wall
