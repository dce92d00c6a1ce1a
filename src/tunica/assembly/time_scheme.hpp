// Generalised-alpha for first-order systems (Jansen, Whiting & Hulbert 2000), docs/theory.md section 4.
#pragma once

namespace tunica::assembly {

/// Parameters of one time step, from the spectral radius at infinite frequency.
///
/// The Newton unknown is v_{n+1}. Velocity is evaluated at t_{n+alpha_f}, its rate at t_{n+alpha_m}. Displacements obey
/// du/dt = v in the same scheme, so du/dt at t_{n+alpha_m} equals v at t_{n+alpha_f} (Kadapa, Dettmer & Peric 2017).
/// Pressure is an algebraic unknown, collocated at t_{n+alpha_f}.
struct TimeScheme {
  double dt;
  double alpha_m, alpha_f, gamma;

  /// rho_infinity in [0, 1].
  static TimeScheme generalised_alpha(double dt, double rho_infinity) {
    const double am = 0.5 * (3.0 - rho_infinity) / (1.0 + rho_infinity);
    const double af = 1.0 / (1.0 + rho_infinity);
    return {dt, am, af, 0.5 + am - af};
  }

  double at_alpha_f(double old_value, double new_value) const { return old_value + alpha_f * (new_value - old_value); }
  double at_alpha_m(double old_rate, double new_rate) const { return old_rate + alpha_m * (new_rate - old_rate); }
  /// Rate at t_{n+1} that takes old_value to new_value.
  double new_rate(double old_value, double old_rate, double new_value) const {
    return ((new_value - old_value) / dt - (1.0 - gamma) * old_rate) / gamma;
  }
  /// Value at t_{n+1} from the rates at both ends.
  double new_value(double old_value, double old_rate, double rate) const {
    return old_value + dt * ((1.0 - gamma) * old_rate + gamma * rate);
  }
  /// Rate at t_{n+1} of a displacement whose rate at t_{n+alpha_m} is `velocity_at_alpha_f`.
  double displacement_rate(double old_rate, double velocity_at_alpha_f) const {
    return old_rate + (velocity_at_alpha_f - old_rate) / alpha_m;
  }

  /// Velocity at t_{n+1} for which the displacement there is `new_displacement`.
  double velocity_towards(double old_displacement, double old_rate, double old_velocity,
                          double new_displacement) const {
    const double at_balance = at_alpha_m(old_rate, new_rate(old_displacement, old_rate, new_displacement));
    return at_end(old_velocity, at_balance);
  }
  /// Value at t_{n+1} of what is `at_balance` at t_{n+alpha_f} and linear in the step.
  double at_end(double old_value, double at_balance) const { return old_value + (at_balance - old_value) / alpha_f; }

  // Derivatives with respect to v_{n+1}.
  double acceleration_per_unknown() const { return alpha_m / (gamma * dt); }
  double velocity_per_unknown() const { return alpha_f; }
  double displacement_per_unknown() const { return alpha_f * alpha_f * gamma * dt / alpha_m; }
};

}  // namespace tunica::assembly
