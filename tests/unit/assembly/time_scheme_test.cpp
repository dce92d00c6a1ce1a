#include "tunica/assembly/time_scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace tunica::assembly {
namespace {

// u'' + omega^2 u = 0 as du/dt = v, dv/dt = -omega^2 u: displacement by the scheme's relations, momentum balanced with
// u at t_{n+alpha_f} and the rate of v at t_{n+alpha_m}. All relations are linear, so two trial values of v_{n+1} give
// the step.
struct Oscillator {
  double omega, u, v, u_rate, v_rate;

  double imbalance(const TimeScheme& scheme, double v_new, Oscillator& next) const {
    next.omega = omega;
    next.v = v_new;
    next.v_rate = scheme.new_rate(v, v_rate, v_new);
    next.u_rate = scheme.displacement_rate(u_rate, scheme.at_alpha_f(v, v_new));
    next.u = scheme.new_value(u, u_rate, next.u_rate);
    return scheme.at_alpha_m(v_rate, next.v_rate) + omega * omega * scheme.at_alpha_f(u, next.u);
  }
  Oscillator step(const TimeScheme& scheme) const {
    Oscillator next{};
    const double r0 = imbalance(scheme, 0.0, next), r1 = imbalance(scheme, 1.0, next);
    imbalance(scheme, r0 / (r0 - r1), next);
    return next;
  }
};

Oscillator at_rest_displaced(double omega) { return {omega, 1.0, 0.0, 0.0, -omega * omega}; }

double error_at_one(double rho_infinity, int steps) {
  const auto scheme = TimeScheme::generalised_alpha(1.0 / steps, rho_infinity);
  auto state = at_rest_displaced(1.0);
  for (int k = 0; k < steps; ++k) state = state.step(scheme);
  return std::hypot(state.u - std::cos(1.0), state.v + std::sin(1.0));
}

TEST(TimeScheme, IsOfSecondOrder) {
  for (const double rho : {0.0, 0.2, 0.5, 1.0}) {
    const double order = std::log2(error_at_one(rho, 40) / error_at_one(rho, 80));
    EXPECT_NEAR(order, 2.0, 0.06) << "rho_infinity " << rho;
  }
}

TEST(TimeScheme, WithRhoOneKeepsTheEnergy) {
  const auto scheme = TimeScheme::generalised_alpha(0.1, 1.0);
  auto state = at_rest_displaced(1.0);
  for (int k = 0; k < 1000; ++k) state = state.step(scheme);
  EXPECT_NEAR(state.u * state.u + state.v * state.v, 1.0, 1e-10);
}

TEST(TimeScheme, DampsInfiniteFrequenciesByRhoInfinity) {
  for (const double rho : {0.1, 0.5, 0.9}) {
    const auto scheme = TimeScheme::generalised_alpha(1.0, rho);
    // At a finite large frequency the spectral radius differs from rho by O(1 / (omega dt)); taken from the decay of
    // the mechanical energy over many steps, whose last part is that of the largest eigenvalues.
    auto state = at_rest_displaced(1e6);
    const auto size = [](const Oscillator& o) { return std::hypot(o.omega * o.u, o.v); };
    for (int k = 0; k < 20; ++k) state = state.step(scheme);
    const double before = size(state);
    for (int k = 0; k < 20; ++k) state = state.step(scheme);
    // Eigenvalues meet at -rho, so a factor linear in the number of steps goes with the power.
    EXPECT_NEAR(std::pow(size(state) / before, 1.0 / 20.0), rho, 0.12 * rho) << "rho_infinity " << rho;
  }
}

TEST(TimeScheme, DisplacementRateAtAlphaMEqualsVelocityAtAlphaF) {
  const auto scheme = TimeScheme::generalised_alpha(0.02, 0.3);
  const double old_rate = 0.7, v_old = -0.4, v_new = 1.9;
  const double rate = scheme.displacement_rate(old_rate, scheme.at_alpha_f(v_old, v_new));
  EXPECT_NEAR(scheme.at_alpha_m(old_rate, rate), scheme.at_alpha_f(v_old, v_new), 1e-15);
}

TEST(TimeScheme, NewValueAndNewRateAreInverse) {
  const auto scheme = TimeScheme::generalised_alpha(0.02, 0.3);
  EXPECT_NEAR(scheme.new_value(2.0, 0.5, scheme.new_rate(2.0, 0.5, 3.25)), 3.25, 1e-14);
}

TEST(TimeScheme, DerivativesAreThoseOfTheRelations) {
  const auto scheme = TimeScheme::generalised_alpha(0.02, 0.3);
  const auto quantities = [&](double v) {
    const double rate = scheme.displacement_rate(0.7, scheme.at_alpha_f(-0.4, v));
    return std::array{scheme.at_alpha_m(0.1, scheme.new_rate(-0.4, 0.1, v)), scheme.at_alpha_f(-0.4, v),
                      scheme.at_alpha_f(0.2, scheme.new_value(0.2, 0.7, rate))};
  };
  const auto a = quantities(1.0), b = quantities(2.0);
  EXPECT_NEAR(b[0] - a[0], scheme.acceleration_per_unknown(), 1e-10);
  EXPECT_NEAR(b[1] - a[1], scheme.velocity_per_unknown(), 1e-14);
  EXPECT_NEAR(b[2] - a[2], scheme.displacement_per_unknown(), 1e-14);
}

}  // namespace
}  // namespace tunica::assembly
