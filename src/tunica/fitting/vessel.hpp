// A law where the vessel works: the incompressible sheet under the stress that the wall bears in the body.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tunica/fitting/protocol.hpp"

namespace tunica::fitting {

/// Cauchy stress along e1 and e2 [Pa], none across e3.
using SheetLoad = std::array<double, 2>;

struct VesselPoint {
  std::array<double, 2> stretch{1.0, 1.0};  ///< along e1, e2
  /// Moduli of small further stretches [Pa]: d sigma11 / d ln lambda1, d sigma22 / d ln lambda2, and the one of the
  /// other axis, d sigma11 / d ln lambda2, at which the other stretch is held.
  std::array<double, 3> moduli{};
};

/// By Newton's method with the load in steps. None where the law does not come to that load: it is too soft, or a sheet
/// that would shear across its thickness.
std::optional<VesselPoint> vessel_point(const wall::Law& law, const SheetLoad& load);

/// Stretches of a sheet at which its energy is not convex in logarithmic strain, the first on a grid from rest up to
/// `largest`, both ways; none where it is convex throughout. Beyond, more strain comes with less Cauchy stress (Hill's
/// inequality is broken), and a computation that goes there need not have one answer. Convexity in Green-Lagrange
/// strain would be too much to ask: a Mooney-Rivlin sheet can lose it at an equal stretch of 1.12.
std::optional<std::array<double, 2>> not_convex_at(const wall::Law& law, const std::array<double, 2>& largest);

/// Largest stretches along e1 and e2 in tests of specimens whose axes lie so; none where nothing was stretched that
/// way.
std::array<std::optional<double>, 2> tested_stretch(const std::vector<Protocol>& protocols);

}  // namespace tunica::fitting
