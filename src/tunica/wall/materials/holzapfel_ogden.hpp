// Orthotropic law of passive heart muscle (Holzapfel & Ogden 2009, eq. 5.38), with fibres along e1 and sheets along e2:
//   Psi = a/(2b) {exp[b (I1 - 3)] - 1} + sum_i a_i/(2 b_i) {exp[b_i (I4i - 1)^2] - 1} + a_fs/(2 b_fs) {exp[b_fs I8fs^2]
//   - 1},
// i = f, s; I4f = C_11, I4s = C_22, I8fs = C_12 in the fibre frame. The first term follows C_bar, the others C_bar or
// C.
#pragma once

#include "tunica/wall/elastic_constants.hpp"
#include "tunica/wall/materials/fibre_energy.hpp"
#include "tunica/wall/materials/fibre_options.hpp"
#include "tunica/wall/materials/fibre_reinforced.hpp"

namespace tunica::wall {

/// The terms of fibres, sheets and the angle between them.
struct FibresAndSheets {
  FibreEnergy along[2];  ///< of I4f - 1, I4s - 1
  FibreEnergy between;   ///< of I8fs
  bool tension_only = true;

  template <class T>
  T energy(const Symmetric<T>& C) const {
    T psi = between.value(C[3]);
    for (int i = 0; i < 2; ++i) psi += along[i].value(admitted(C[i] - T(1.0), tension_only));
    return psi;
  }
  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C) const {
    const T zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    for (int i = 0; i < 2; ++i) {
      const T E = admitted(C[i] - T(1.0), tension_only);
      S[i] = T(2.0) * along[i].slope(E, along[i].exponential(E));
    }
    S[3] = between.slope(C[3], between.exponential(C[3]));  // dC_12/dC is one half of f (x) s + s (x) f
    return S;
  }
  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C) const {
    Response<T> r = zero_response<T>();
    for (int i = 0; i < 2; ++i) {
      const T raw = C[i] - T(1.0), E = admitted(raw, tension_only), e = along[i].exponential(E);
      r.stress[i] = T(2.0) * along[i].slope(E, e);
      const T curvature = T(4.0) * along[i].curvature(E, e);
      r.tangent(i, i) = tension_only ? select(raw > T(switch_strain), curvature, T(0.0)) : curvature;
    }
    const T e = between.exponential(C[3]);
    r.stress[3] = between.slope(C[3], e);
    r.tangent(3, 3) = between.curvature(C[3], e);
    return r;
  }
};

/// a/(2b) {exp[b (I1_bar - 3)] - 1}.
struct ExponentialMatrix {
  double a = 0.0, b = 0.0;  ///< [Pa], [-]

  template <class T>
  T energy(const Symmetric<T>& C_bar) const {
    return T(0.5 * a / b) * (exp(T(b) * (trace(C_bar) - T(3.0))) - T(1.0));
  }
  template <class T>
  TUNICA_INLINE void add_stress(const Symmetric<T>& C_bar, Symmetric<T>& S) const {
    const T slope = T(a) * exp(T(b) * (trace(C_bar) - T(3.0)));
    for (int n = 0; n < 3; ++n) S[n] += slope;
  }
  template <class T>
  TUNICA_INLINE void add_response(const Symmetric<T>& C_bar, Response<T>& r) const {
    const T slope = T(a) * exp(T(b) * (trace(C_bar) - T(3.0))), curvature = T(2.0 * b) * slope;
    for (int i = 0; i < 3; ++i) {
      r.stress[i] += slope;
      for (int j = i; j < 3; ++j) r.tangent(i, j) += curvature;
    }
  }
  double shear_modulus_at_rest() const { return a; }
};

using HolzapfelOgden = FibreReinforced<FibresAndSheets, ExponentialMatrix>;

struct HolzapfelOgdenParameters {
  double a = 0.0, b = 0.0;  ///< [Pa], [-]
  double a_f = 0.0, b_f = 0.0, a_s = 0.0, b_s = 0.0, a_fs = 0.0, b_fs = 0.0;
  FibreOptions options;
  Compressibility compressibility;

  HolzapfelOgden law() const {
    return {{a, b}, options.unsplit, {{{a_f, b_f}, {a_s, b_s}}, {a_fs, b_fs}, options.tension_only}};
  }
  double shear_modulus() const { return a; }
  double bulk_modulus() const { return compressibility.bulk(shear_modulus()); }
  static config::Schema<HolzapfelOgdenParameters> schema();
};

}  // namespace tunica::wall
