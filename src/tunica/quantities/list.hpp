// The quantities of this folder, in the order in which results have them: `X(velocity)` stands for the function
// `Quantity velocity()` in velocity.cpp.
#pragma once

#include "tunica/quantities/quantity.hpp"

#define TUNICA_QUANTITIES(X) \
  X(velocity)                \
  X(displacement)            \
  X(pressure)                \
  X(wall_shear_stress)       \
  X(wall_pressure)           \
  X(von_mises_stress)        \
  X(first_principal_stress)  \
  X(fibre_stress)            \
  X(acceleration)            \
  X(velocity_gradient)       \
  X(vorticity)               \
  X(traction)                \
  X(cauchy_stress)           \
  X(principal_stresses)      \
  X(principal_directions)    \
  X(mean_stress)             \
  X(deformation_gradient)    \
  X(green_lagrange_strain)   \
  X(principal_stretches)     \
  X(fibre_stretch)           \
  X(jacobian)

namespace tunica::quantities {
#define TUNICA_DECLARE(name) Quantity name();
TUNICA_QUANTITIES(TUNICA_DECLARE)
#undef TUNICA_DECLARE
}  // namespace tunica::quantities
