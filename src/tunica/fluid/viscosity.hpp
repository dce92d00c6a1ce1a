// Viscosity laws of blood: mu as a function of the shear rate gamma = sqrt(2 eps:eps), and its derivative.
//
// A law is a struct of named parameters (SI) with two templates, viscosity(gamma) [Pa s] and slope(gamma) = d mu/d
// gamma [Pa s^2], and the flag `constant` that lets a kernel drop the slope. To add a law: write it here, give it a
// schema and append it to `Viscosity`. The kernels keep gamma away from zero (see shear_rate in rbvms.hpp), so laws
// whose slope is singular there, as Carreau-Yasuda with a < 1, need no special case.
#pragma once

#include <variant>

#include "tunica/base/dual.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::config {
template <class T>
class Schema;
}

namespace tunica::fluid {

/// mu = constant.
struct Newtonian {
  static constexpr bool constant = true;
  double mu = 4e-3;  ///< viscosity [Pa s]

  template <class T>
  T viscosity(const T&) const {
    return T(mu);
  }
  template <class T>
  T slope(const T&) const {
    return T(0.0);
  }

  static config::Schema<Newtonian> schema();
};

/// mu = mu_inf + (mu_0 - mu_inf) [1 + (lambda gamma)^a]^((n-1)/a). Constants of human blood: Cho & Kensey 1991;
/// section 2 of the theory.
struct CarreauYasuda {
  static constexpr bool constant = false;
  double mu_infinity = 3.45e-3;  ///< at high shear rates [Pa s]
  double mu_zero = 56e-3;        ///< at rest [Pa s]
  double lambda = 1.902;         ///< relaxation time [s]
  double a = 1.25;               ///< width of the transition [-]
  double n = 0.22;               ///< power-law exponent [-]

  template <class T>
  T viscosity(const T& gamma) const {
    return T(mu_infinity) + T(mu_zero - mu_infinity) * pow(T(1.0) + pow(T(lambda) * gamma, a), (n - 1.0) / a);
  }
  template <class T>
  T slope(const T& gamma) const {
    const T x = pow(T(lambda) * gamma, a);
    return T((mu_zero - mu_infinity) * (n - 1.0)) * x * pow(T(1.0) + x, (n - 1.0 - a) / a) / gamma;
  }

  static config::Schema<CarreauYasuda> schema();
};

/// sqrt(tau) = sqrt(tau_y) + sqrt(mu_inf gamma), so mu = [sqrt(mu_inf) + sqrt(tau_y / gamma)]^2 (Casson 1959; blood:
/// Merrill et al. 1963). Regularised by replacing gamma with sqrt(gamma^2 + gamma_0^2) (Bercovier & Engelman 1980): the
/// viscosity at rest is the finite [sqrt(mu_inf) + sqrt(tau_y / gamma_0)]^2, smooth in gamma, and the law is untouched
/// where gamma >> gamma_0. The default gamma_0 is the lowest shear rate at which blood has been measured.
struct Casson {
  static constexpr bool constant = false;
  double mu_infinity = 3.45e-3;          ///< Casson viscosity [Pa s]
  double yield_stress = 5e-3;            ///< [Pa]
  double regularising_shear_rate = 0.1;  ///< gamma_0 [1/s]

  template <class T>
  T viscosity(const T& gamma) const {
    const T s = T(std::sqrt(mu_infinity)) + sqrt(T(yield_stress) / regularised(gamma));
    return s * s;
  }
  template <class T>
  T slope(const T& gamma) const {
    const T g = regularised(gamma), y = sqrt(T(yield_stress) / g);
    return -(T(std::sqrt(mu_infinity)) + y) * y * gamma / (g * g);
  }

  static config::Schema<Casson> schema();

 private:
  template <class T>
  T regularised(const T& gamma) const {
    return sqrt(gamma * gamma + T(regularising_shear_rate * regularising_shear_rate));
  }
};

/// All viscosity laws.
using Viscosity = std::variant<Newtonian, CarreauYasuda, Casson>;

/// Case-file section that holds one of the laws.
config::Schema<Viscosity> viscosity_schema();

}  // namespace tunica::fluid
