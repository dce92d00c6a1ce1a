#include "tunica/wall/fibres/density.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace tunica::wall {

namespace {

// Every exponential below is divided by its largest value, so that no concentration overflows.

/// int_0^1 exp(y (t^2 - 1)) dt for y >= 0, which is Dawson's integral of sqrt(y) over sqrt(y). All terms of the power
/// series are positive; beyond y = 40 the smallest term of the asymptotic one is below rounding.
double concentrated_integral(double y) {
  double term = 1.0, sum = 0.0;
  if (y <= 40.0) {
    for (int k = 0; k == 0 || term > 1e-17 * sum; ++k) {
      sum += term / (2 * k + 1);
      term *= y / (k + 1);
    }
    return std::exp(-y) * sum;
  }
  for (int k = 0; k < 40 && term > 1e-17; ++k) {
    sum += term;
    term *= (2 * k + 1) / (2.0 * y);
  }
  return sum / (2.0 * y);
}

/// exp(-a) I_n(a) for n = 0 and 1. Beyond a = 50 by the asymptotic series, Abramowitz & Stegun 9.7.1.
double scaled_bessel(int n, double a) {
  if (a <= 50.0) return std::exp(-a) * std::cyl_bessel_i(static_cast<double>(n), a);
  double term = 1.0, sum = 0.0;
  for (int k = 1; std::abs(term) > 1e-17; ++k) {
    sum += term;
    term *= -(4.0 * n * n - (2.0 * k - 1.0) * (2.0 * k - 1.0)) / (8.0 * a * k);
  }
  return sum / std::sqrt(2.0 * std::numbers::pi * a);
}

double of(const VonMises& d, const Vec3<double>& N) {
  const double y = 2.0 * d.concentration, t = dot(N, d.mean_direction);
  return std::exp(y * (t * t - 1.0)) / concentrated_integral(y);
}

double of(const BivariateVonMises& d, const Vec3<double>& N) {
  const double y = 2.0 * d.out_of_plane;
  const double mean = y > 0.0 ? std::erf(std::sqrt(y)) * std::sqrt(0.25 * std::numbers::pi / y) : 1.0;
  const double out_of_plane = std::exp(-y * N[2] * N[2]) / mean;
  const double squared = N[0] * N[0] + N[1] * N[1];
  if (squared == 0.0) return out_of_plane;
  const double along = N[0] * std::cos(d.mean_angle) + N[1] * std::sin(d.mean_angle);
  const double cosine = 2.0 * along * along / squared - 1.0;  // of 2 (Phi - alpha)
  return out_of_plane * std::exp(d.in_plane * (cosine - 1.0)) / scaled_bessel(0, d.in_plane);
}

/// Mean of s^2 under exp(y s^2) on [0, 1]; y of either sign, moderate.
double mean_square(double y) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double peak = std::max(y, 0.0);
  const auto weight = [&](double s) { return std::exp(y * s * s - peak); };
  return Gauss::integrate([&](double s) { return s * s * weight(s); }, 0.0, 1.0) / Gauss::integrate(weight, 0.0, 1.0);
}

// The closed forms lose digits at small concentrations, quadrature at large ones.
constexpr double quadrature_limit = 5.0;

}  // namespace

double density(const Density& d, const Vec3<double>& N) {
  return std::visit([&](const auto& kind) { return of(kind, N); }, d);
}

double kappa(const VonMises& d) {
  const double y = 2.0 * d.concentration;
  const double square = y <= quadrature_limit ? mean_square(y) : (1.0 / concentrated_integral(y) - 1.0) / (2.0 * y);
  return 0.5 * (1.0 - square);
}

double kappa_in_plane(const BivariateVonMises& d) {
  return 0.5 - 0.5 * scaled_bessel(1, d.in_plane) / scaled_bessel(0, d.in_plane);
}

double kappa_out_of_plane(const BivariateVonMises& d) {
  const double b = d.out_of_plane;
  if (2.0 * b <= quadrature_limit) return 0.5 * (1.0 - mean_square(-2.0 * b));
  return 0.5 - 0.125 / b +
         0.25 * std::sqrt(2.0 / (std::numbers::pi * b)) * std::exp(-2.0 * b) / std::erf(std::sqrt(2.0 * b));
}

}  // namespace tunica::wall
