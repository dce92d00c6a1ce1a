// Fung-type orthotropic law: Psi = c/2 (exp Q - 1) with Q quadratic in the Green-Lagrange strain E = (C_bar - I)/2,
//   Q = b_cc Ecc^2 + b_ll Ell^2 + b_rr Err^2 + 2 b_cl Ecc Ell + 2 b_lr Ell Err + 2 b_rc Err Ecc
//       + g_cl Ecl^2 + g_lr Elr^2 + g_rc Erc^2,
// c circumferential, l longitudinal, r radial (Chuong & Fung 1983 with shear; Holzapfel, Gasser & Ogden 2000, eq. 38).
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

struct Fung {
  double c = 0.0;                        ///< [Pa]
  double normal[3] = {}, cross[3] = {};  ///< b_cc b_ll b_rr, b_cl b_lr b_rc
  double shear[3] = {};                  ///< g_cl g_lr g_rc

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    const Symmetric<T> E = strain(C_bar);
    return T(0.5 * c) * (exp(double_dot(E, slope(E))) - T(1.0));
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C_bar) const {
    const Symmetric<T> E = strain(C_bar), BE = slope(E);
    return T(c) * exp(double_dot(E, BE)) * BE;
  }
  /// S = c e^Q BE and CC = dS/dE = c e^Q (B + 2 BE (x) BE).
  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C_bar) const {
    const Symmetric<T> E = strain(C_bar), BE = slope(E);
    const T factor = T(c) * exp(double_dot(E, BE));
    Response<T> r;
    r.stress = factor * BE;
    for (int i = 0; i < voigt_size; ++i)
      for (int j = i; j < voigt_size; ++j) r.tangent(i, j) = factor * T(2.0) * BE[i] * BE[j];
    for (int i = 0; i < 3; ++i) {
      r.tangent(i, i) += factor * T(normal[i]);
      r.tangent(i, (i + 1) % 3) += factor * T(cross[i]);
      r.tangent(i + 3, i + 3) += factor * T(0.25 * shear[i]);
    }
    return r;
  }
  /// The least of the three shear moduli c g / 4.
  double shear_modulus_at_rest() const { return 0.25 * c * min(shear[0], min(shear[1], shear[2])); }

 private:
  template <class T>
  static TUNICA_INLINE Symmetric<T> strain(const Symmetric<T>& C_bar) {
    Symmetric<T> E = T(0.5) * C_bar;
    for (int n = 0; n < 3; ++n) E[n] -= T(0.5);
    return E;
  }
  /// dQ/dE / 2 as a tensor; Q = E : slope.
  template <class T>
  TUNICA_INLINE Symmetric<T> slope(const Symmetric<T>& E) const {
    return {{T(normal[0]) * E[0] + T(cross[0]) * E[1] + T(cross[2]) * E[2],
             T(cross[0]) * E[0] + T(normal[1]) * E[1] + T(cross[1]) * E[2],
             T(cross[2]) * E[0] + T(cross[1]) * E[1] + T(normal[2]) * E[2], T(0.5 * shear[0]) * E[3],
             T(0.5 * shear[1]) * E[4], T(0.5 * shear[2]) * E[5]}};
  }
};

struct FungParameters {
  double c = 0.0;  ///< [Pa]
  double b_cc = 0.0, b_ll = 0.0, b_rr = 0.0, b_cl = 0.0, b_lr = 0.0, b_rc = 0.0;
  double g_cl = 0.0, g_lr = 0.0, g_rc = 0.0;
  Compressibility compressibility;

  Fung law() const { return {c, {b_cc, b_ll, b_rr}, {b_cl, b_lr, b_rc}, {g_cl, g_lr, g_rc}}; }
  double shear_modulus() const { return law().shear_modulus_at_rest(); }
  double bulk_modulus() const { return compressibility.bulk(shear_modulus()); }
  /// Q must be positive definite, else the law is not convex.
  static config::Schema<FungParameters> schema();
};

}  // namespace tunica::wall
