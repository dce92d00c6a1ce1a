// Viscous stress of the wall beside that of its law (Kelvin-Voigt); its forces: viscous_forces.hpp.
#pragma once

namespace tunica::config {
template <class T>
class Schema;
}

namespace tunica::wall {

/// Of all regions alike.
struct Viscosity {
  enum class Law {
    newtonian,  ///< sigma = 2 eta dev d, d the rate of deformation
    potential   ///< S = eta dE/dt
  };
  Law law = Law::newtonian;
  double value = 0.0;  ///< eta [Pa s]
  static config::Schema<Viscosity> schema();
};

}  // namespace tunica::wall
