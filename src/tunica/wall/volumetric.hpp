// Volumetric energies (1.2) and their constraint form for the mixed element.
//
// U(J) = K G(J), p_vol = U'(J) = K g(J) with g = G'. All three have g(1) = 0 and g'(1) = 1. The mixed element asks for
// g(J) + p/K = 0 with p positive in compression, so K may be infinite (Poisson's ratio 0.5).
#pragma once

#include <limits>

#include "tunica/base/dual.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::wall {

enum class VolumetricEnergy {
  simo_taylor,  ///< K/4 (J^2 - 1 - 2 ln J)
  quadratic,    ///< K/2 (J - 1)^2
  miehe         ///< K (J - ln J - 1)
};

/// The three energies must not be mixed within one batch; K may differ between its lanes (`Scalar`).
template <class Scalar>
struct VolumetricOf {
  VolumetricEnergy energy = VolumetricEnergy::simo_taylor;
  Scalar bulk_modulus = std::numeric_limits<double>::infinity();  ///< K [Pa], infinite when incompressible

  /// 1/K [1/Pa], zero when incompressible.
  TUNICA_INLINE Scalar compressibility() const { return Scalar(1.0) / bulk_modulus; }

  /// G(J) [-].
  template <class T>
  TUNICA_INLINE T unit_energy(const T& J) const {
    if (energy == VolumetricEnergy::simo_taylor) return T(0.25) * (J * J - T(1.0) - T(2.0) * log(J));
    if (energy == VolumetricEnergy::quadratic) return T(0.5) * (J - T(1.0)) * (J - T(1.0));
    return J - log(J) - T(1.0);
  }
  /// g(J) = dG/dJ [-].
  template <class T>
  TUNICA_INLINE T unit_pressure(const T& J) const {
    if (energy == VolumetricEnergy::simo_taylor) return T(0.5) * (J - T(1.0) / J);
    if (energy == VolumetricEnergy::quadratic) return J - T(1.0);
    return T(1.0) - T(1.0) / J;
  }
  /// dg/dJ [-].
  template <class T>
  TUNICA_INLINE T unit_stiffness(const T& J) const {
    if (energy == VolumetricEnergy::simo_taylor) return T(0.5) * (T(1.0) + T(1.0) / (J * J));
    if (energy == VolumetricEnergy::quadratic) return T(1.0);
    return T(1.0) / (J * J);
  }
  /// d2g/dJ2 [-].
  template <class T>
  TUNICA_INLINE T unit_curvature(const T& J) const {
    if (energy == VolumetricEnergy::quadratic) return T(0.0);
    return T(energy == VolumetricEnergy::simo_taylor ? -1.0 : -2.0) / (J * J * J);
  }
};

using Volumetric = VolumetricOf<double>;

}  // namespace tunica::wall
