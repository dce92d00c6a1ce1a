#include "tunica/fluid/parameters.hpp"

#include "tunica/config/schema.hpp"

namespace tunica::fluid {

using namespace config;

Schema<Newtonian> Newtonian::schema() {
  return Schema<Newtonian>("newtonian", "Constant viscosity.")
      .quantity("viscosity", &Newtonian::mu, dimension::dynamic_viscosity, above(0), "Of blood: 3.5 to 4 mPa s")
      .by_default()
      .plausible("0.1 mPa s", "100 mPa s");
}

Schema<CarreauYasuda> CarreauYasuda::schema() {
  using Law = CarreauYasuda;
  return Schema<Law>("carreau_yasuda", "mu = mu_inf + (mu_0 - mu_inf) [1 + (lambda gamma)^a]^((n-1)/a).")
      .quantity("viscosity_at_high_shear", &Law::mu_infinity, dimension::dynamic_viscosity, above(0), "mu_inf")
      .by_default()
      .plausible("0.1 mPa s", "100 mPa s")
      .quantity("viscosity_at_rest", &Law::mu_zero, dimension::dynamic_viscosity, above(0), "mu_0")
      .by_default()
      .plausible("0.1 mPa s", "1 Pa s")
      .quantity("relaxation_time", &Law::lambda, dimension::time, above(0), "lambda")
      .by_default()
      .number("transition", &Law::a, above(0), "a: the larger, the sharper the turn from plateau to power law")
      .by_default()
      .number("exponent", &Law::n, above(0), "n of the power law; below 1 for a fluid that thins")
      .by_default();
}

Schema<Casson> Casson::schema() {
  return Schema<Casson>("casson", "mu = [sqrt(mu_inf) + sqrt(tau_y / g)]^2 with g^2 = gamma^2 + gamma_0^2.")
      .quantity("viscosity_at_high_shear", &Casson::mu_infinity, dimension::dynamic_viscosity, above(0), "mu_inf")
      .by_default()
      .plausible("0.1 mPa s", "100 mPa s")
      .quantity("yield_stress", &Casson::yield_stress, dimension::pressure, at_least(0), "tau_y")
      .by_default()
      .plausible("0 Pa", "1 Pa")
      .quantity("regularising_shear_rate", &Casson::regularising_shear_rate, dimension::frequency, above(0),
                "gamma_0: below it the fluid is taken to be Newtonian")
      .by_default();
}

Schema<Viscosity> viscosity_schema() {
  return Schema<Viscosity>("viscosity", "Viscosity law.")
      .one_of()
      .alternative(Newtonian::schema())
      .alternative(CarreauYasuda::schema())
      .alternative(Casson::schema());
}

Schema<Parameters> Parameters::schema() {
  return Schema<Parameters>("blood", "Incompressible flow.")
      .quantity("density", &Parameters::density, dimension::density, above(0), "Of blood: 1060 kg/m^3")
      .by_default()
      .plausible("500 kg/m^3", "2000 kg/m^3")
      .section("viscosity", &Parameters::viscosity, viscosity_schema(), "Viscosity law")
      .by_default("newtonian")
      .number("transient_constant", &Parameters::c_m, above(0), "c_M of the stabilisation parameter tau_M")
      .by_default()
      .number("viscous_constant", &Parameters::c_i, above(0), "c_I of the stabilisation parameter tau_M")
      .by_default()
      .choice("stabilisation", &Parameters::stabilisation,
              {{"bounded", Stabilisation::bounded}, {"vms_classic", Stabilisation::vms_classic}},
              "tau_C of linear elements: bounded as the step shrinks, or as related codes have it, with the step")
      .by_default()
      .number("backflow_stabilisation", &Parameters::backflow, range(0, 1),
              "beta of the outlets; 0.5 cancels the kinetic energy that enters by reversed flow")
      .by_default();
}

}  // namespace tunica::fluid
