// St. Venant-Kirchhoff law of an isotropic wall: Psi = mu dev(E):dev(E) + U(J), E = (C - 1)/2. Holzapfel, Nonlinear
// Solid Mechanics (2000), section 6.5.
//
// The published law has K/2 tr(E)^2 in place of U(J), which is the same up to the second order of the strain and loses
// its resistance under compression; here the change of volume is the element's, so that the law is right up to
// incompressibility. The rest is a function of C itself, outside the isochoric split.
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

struct StVenantKirchhoff {
  static constexpr bool linear = true;

  double shear_modulus = 0.0;  ///< mu [Pa]

  template <class T>
  TUNICA_INLINE T energy(const Symmetric<T>&) const {
    return T(0.0);
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>&) const {
    return zero_response<T>().stress;
  }

  bool has_unsplit_part() const { return true; }
  template <class T>
  T unsplit_energy(const Symmetric<T>& C) const {
    return T(0.25 * shear_modulus) * (double_dot(C, C) - T(1.0 / 3.0) * trace(C) * trace(C));
  }
  template <class T>
  Symmetric<T> unsplit_stress(const Symmetric<T>& C) const {
    const T third = T(1.0 / 3.0) * trace(C);
    Symmetric<T> S = T(shear_modulus) * C;
    for (int n = 0; n < 3; ++n) S[n] -= T(shear_modulus) * third;
    return S;
  }
  template <class T>
  Response<T> unsplit_response(const Symmetric<T>& C) const {
    Response<T> r = zero_response<T>();
    r.stress = unsplit_stress(C);
    for (int i = 0; i < 3; ++i) {
      r.tangent(i, i) = T(4.0 / 3.0 * shear_modulus);
      r.tangent(i + 3, i + 3) = T(shear_modulus);
    }
    r.tangent(0, 1) = r.tangent(0, 2) = r.tangent(1, 2) = T(-2.0 / 3.0 * shear_modulus);
    return r;
  }
  double shear_modulus_at_rest() const { return shear_modulus; }
};

struct StVenantKirchhoffParameters {
  ElasticConstants elastic;

  StVenantKirchhoff law() const { return {.shear_modulus = elastic.shear()}; }
  double shear_modulus() const { return elastic.shear(); }
  double bulk_modulus() const { return elastic.bulk(); }
  static config::Schema<StVenantKirchhoffParameters> schema() {
    return config::Schema<StVenantKirchhoffParameters>(
               "st_venant_kirchhoff", "Isotropic law of small strains and large rotations, mu dev(E):dev(E).")
        .include(&StVenantKirchhoffParameters::elastic, ElasticConstants::schema());
  }
};

}  // namespace tunica::wall
