// Energy of one fibre direction, (1.4), and what all fibre laws share.
#pragma once

#include <numbers>

#include "tunica/wall/material_concept.hpp"

namespace tunica::wall {

/// f(E) = k1/(2 k2) {exp[k2 E^2] - 1} with E = I - 1, I the squared fibre stretch; k1/2 E^2 for k2 = 0. Its derivatives
/// are given the exponential, so that it is computed once.
struct FibreEnergy {
  double k1 = 0.0;  ///< stress-like [Pa]
  double k2 = 0.0;  ///< [-]

  template <class T>
  T value(const T& E) const {
    if (k2 == 0.0) return T(0.5 * k1) * E * E;
    return T(0.5 * k1 / k2) * (exp(T(k2) * E * E) - T(1.0));
  }
  /// exp[k2 E^2]
  template <class T>
  TUNICA_INLINE T exponential(const T& E) const {
    return exp2_of_nonnegative(T(k2 * std::numbers::log2e) * (E * E));
  }
  /// f'(E) [Pa]
  template <class T>
  TUNICA_INLINE T slope(const T& E, const T& exponential) const {
    return T(k1) * E * exponential;
  }
  /// f''(E) [Pa]
  template <class T>
  TUNICA_INLINE T curvature(const T& E, const T& exponential) const {
    return T(k1) * (T(1.0) + T(2.0 * k2) * E * E) * exponential;
  }
};

/// Strain above which a direction counts as pulling. At rest all strains are zero up to rounding; all directions then
/// have the stiffness of a fibre that pulls, whatever the rounding, so that Newton's first step from rest is a short
/// one.
inline constexpr double switch_strain = -1e-12;

/// Fibres that are excluded in compression have no strain there.
template <class T>
TUNICA_INLINE T admitted(const T& strain, bool tension_only) {
  return tension_only ? max(strain, T(0.0)) : strain;
}

}  // namespace tunica::wall
