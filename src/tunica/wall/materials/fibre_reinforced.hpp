// A matrix with fibres in it, (1.13). The fibres follow either C_bar, as in the original laws, or C (unsplit, Nolan et
// al. 2014); the matrix follows C_bar.
#pragma once

#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

/// mu/2 (I1_bar - 3).
struct NeoHookeanMatrix {
  double shear_modulus = 0.0;  ///< mu [Pa]

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    return T(0.5 * shear_modulus) * (trace(C_bar) - T(3.0));
  }
  template <class T>
  TUNICA_INLINE void add_stress(const Symmetric<T>&, Symmetric<T>& S) const {
    const T mu(shear_modulus);
    for (int n = 0; n < 3; ++n) S[n] += mu;
  }
  template <class T>
  TUNICA_INLINE void add_response(const Symmetric<T>&, Response<T>& r) const {
    for (int n = 0; n < 3; ++n) r.stress[n] += T(shear_modulus);
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

template <class Fibres, class Matrix = NeoHookeanMatrix>
struct FibreReinforced {
  Matrix matrix;
  bool unsplit = false;  ///< do the fibres follow C?
  Fibres fibres;

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    const T of_matrix = matrix.energy(C_bar);
    return unsplit ? of_matrix : of_matrix + fibres.energy(C_bar);
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C_bar) const {
    const T zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    if (!unsplit) S = fibres.stress(C_bar);
    matrix.add_stress(C_bar, S);
    return S;
  }
  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C_bar) const {
    Response<T> r = unsplit ? zero_response<T>() : fibres.response(C_bar);
    matrix.add_response(C_bar, r);
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
  double shear_modulus_at_rest() const { return matrix.shear_modulus_at_rest(); }
};

}  // namespace tunica::wall
