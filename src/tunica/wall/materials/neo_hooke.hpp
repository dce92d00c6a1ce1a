// Isochoric neo-Hooke, (1.3): Psi = mu/2 (I1_bar - 3). Holzapfel, Nonlinear Solid Mechanics (2000), section 6.5.
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

struct NeoHooke {
  static constexpr bool linear = true;

  struct Parameters {
    ElasticConstants elastic;
    static config::Schema<Parameters> schema() {
      return config::Schema<Parameters>("neo_hooke", "Isotropic neo-Hooke law, mu/2 (I1 - 3).")
          .include(&Parameters::elastic, ElasticConstants::schema());
    }
  };
  static NeoHooke from(const Parameters& p) { return {.shear_modulus = p.elastic.shear()}; }

  double shear_modulus;  ///< mu [Pa]

  template <class T>
  TUNICA_INLINE T energy(const Symmetric<T>& C_bar) const {
    return T(0.5 * shear_modulus) * (trace(C_bar) - T(3.0));
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>&) const {
    const T mu(shear_modulus), zero(0.0);
    return {{mu, mu, mu, zero, zero, zero}};
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

}  // namespace tunica::wall
