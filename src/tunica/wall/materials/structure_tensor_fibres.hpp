// Families of fibres that enter through a structure tensor H with tr H = 1: E = C : H - 1,
//   Psi = sum_i k1/(2 k2) {exp[k2 E_i^2] - 1},                                                                 (1.4)
// with H = M (x) M for aligned fibres (Holzapfel, Gasser & Ogden 2000) and a generalised structure tensor for dispersed
// ones (Gasser, Ogden & Holzapfel 2006; Holzapfel et al. 2015). The switch of tension-only fibres tests E itself, so
// that Psi is continuously differentiable.
#pragma once

#include <vector>

#include "tunica/wall/materials/fibre_energy.hpp"

namespace tunica::wall {

struct StructureTensorFibres {
  struct Family {
    FibreEnergy energy;
    Symmetric<double> H;  ///< structure tensor in the fibre frame, trace 1
  };
  std::vector<Family> families;
  bool tension_only = true;

  template <class T>
  T energy(const Symmetric<T>& C) const {
    T psi(0.0);
    for (const Family& family : families) psi += family.energy.value(admitted(strain(family, C), tension_only));
    return psi;
  }

  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C) const {
    const T zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    for (const Family& family : families) {
      const T E = admitted(strain(family, C), tension_only);
      const T slope = T(2.0) * family.energy.slope(E, family.energy.exponential(E));
      for (int n = 0; n < voigt_size; ++n) S[n] += slope * T(family.H[n]);
    }
    return S;
  }

  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C) const {
    Response<T> r;
    for (T& x : r.stress.v) x = T(0.0);
    for (T& x : r.tangent.v) x = T(0.0);
    for (const Family& family : families) {
      const T raw = strain(family, C), E = admitted(raw, tension_only);
      const T e = family.energy.exponential(E);
      const T slope = T(2.0) * family.energy.slope(E, e);
      T curvature = T(4.0) * family.energy.curvature(E, e);
      if (tension_only) curvature = select(raw > T(switch_strain), curvature, T(0.0));
#pragma GCC unroll 6
      for (int i = 0; i < voigt_size; ++i) {
        r.stress[i] += slope * T(family.H[i]);
        const T row = curvature * T(family.H[i]);
#pragma GCC unroll 6
        for (int j = i; j < voigt_size; ++j) r.tangent(i, j) += row * T(family.H[j]);
      }
    }
    return r;
  }

 private:
  template <class T>
  static TUNICA_INLINE T strain(const Family& family, const Symmetric<T>& C) {
    T E(-1.0);
    for (int n = 0; n < voigt_size; ++n) E += T((n < 3 ? 1.0 : 2.0) * family.H[n]) * C[n];
    return E;
  }
};

}  // namespace tunica::wall
