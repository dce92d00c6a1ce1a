// Isochoric neo-Hooke, (1.3): Psi = mu/2 (I1_bar - 3). Holzapfel, Nonlinear Solid Mechanics (2000), section 6.5.
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

/// In a batch, the modulus may differ between the lanes (`Scalar`).
template <class Scalar>
struct NeoHookeOf {
  static constexpr bool linear = true;

  Scalar shear_modulus;  ///< mu [Pa]

  template <class T>
  TUNICA_INLINE T energy(const Symmetric<T>& C_bar) const {
    return T(0.5) * T(shear_modulus) * (trace(C_bar) - T(3.0));
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>&) const {
    const T mu(shear_modulus), zero(0.0);
    return {{mu, mu, mu, zero, zero, zero}};
  }
  TUNICA_INLINE Scalar shear_modulus_at_rest() const { return shear_modulus; }
};

using NeoHooke = NeoHookeOf<double>;

struct NeoHookeParameters {
  ElasticConstants elastic;

  NeoHooke law() const { return {.shear_modulus = elastic.shear()}; }
  double shear_modulus() const { return elastic.shear(); }
  double bulk_modulus() const { return elastic.bulk(); }
  static config::Schema<NeoHookeParameters> schema() {
    return config::Schema<NeoHookeParameters>("neo_hooke", "Isotropic neo-Hooke law, mu/2 (I1 - 3).")
        .include(&NeoHookeParameters::elastic, ElasticConstants::schema());
  }
};

}  // namespace tunica::wall
