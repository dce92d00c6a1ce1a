// Parameters of the blood flow model.
#pragma once

#include "tunica/fluid/viscosity.hpp"

namespace tunica::fluid {

/// Which rate of the flow tau_C of linear elements counts, eq (2.2).
enum class Stabilisation {
  bounded,     ///< convection and diffusion: tau_C does not grow as the step shrinks
  vms_classic  ///< that of the step too (Bazilevs et al. 2007), as related codes do
};

/// Constants of eqs (2.1)-(2.4) and of the backflow stabilisation (section 4). SI units.
struct Parameters {
  double density = 1060.0;  ///< rho [kg/m^3]
  Viscosity viscosity;      ///< law of mu
  double c_m = 1.0;         ///< transient constant of tau_M, eq (2.2)
  double c_i = 36.0;        ///< viscous constant of tau_M, eq (2.2)
  Stabilisation stabilisation = Stabilisation::bounded;
  double backflow = 0.2;  ///< beta: 0 no stabilisation, 1/2 cancels the kinetic energy that flows in through an outlet

  static config::Schema<Parameters> schema();
};

}  // namespace tunica::fluid
