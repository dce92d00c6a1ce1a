// Isochoric Mooney-Rivlin: Psi = c1 (I1_bar - 3) + c2 (I2_bar - 3). Holzapfel, Nonlinear Solid Mechanics (2000), 6.5.
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

struct MooneyRivlin {
  double c1 = 0.0, c2 = 0.0;  ///< [Pa]

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    const T I1 = trace(C_bar), I2 = T(0.5) * (I1 * I1 - double_dot(C_bar, C_bar));
    return T(c1) * (I1 - T(3.0)) + T(c2) * (I2 - T(3.0));
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C_bar) const {
    const T spherical = T(2.0 * c1) + T(2.0 * c2) * trace(C_bar);
    Symmetric<T> S = T(-2.0 * c2) * C_bar;
    for (int n = 0; n < 3; ++n) S[n] += spherical;
    return S;
  }
  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C_bar) const {
    Response<T> r{stress(C_bar), {}};
    for (T& x : r.tangent.v) x = T(0.0);
    for (int i = 0; i < 3; ++i) {
      r.tangent(i, (i + 1) % 3) = T(4.0 * c2);
      r.tangent(i + 3, i + 3) = T(-2.0 * c2);
    }
    return r;
  }
  double shear_modulus_at_rest() const { return 2.0 * (c1 + c2); }
};

struct MooneyRivlinParameters {
  double c1 = 0.0, c2 = 0.0;  ///< [Pa]
  Compressibility compressibility;

  MooneyRivlin law() const { return {c1, c2}; }
  double shear_modulus() const { return law().shear_modulus_at_rest(); }
  double bulk_modulus() const { return compressibility.bulk(shear_modulus()); }
  static config::Schema<MooneyRivlinParameters> schema();
};

}  // namespace tunica::wall
