#include "tunica/stages/material/verify_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "tunica/base/error.hpp"

namespace tunica::stages {

namespace {

/// Adaptive; `from` to `to` must hold no kink of `f`.
template <class Function>
double integral(const Function& f, double from, double to) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  double error = 0.0, size = 0.0;
  const double value = Rule::integrate(f, from, to, 12, 1e-11, &error, &size);
  if (!(error <= 1e-8 * size))
    throw SolverError(fmt::format("the integral of the fibre density is off by {:.1e}", error));
  return value;
}

/// rho f'(I - 1) at the direction N, where fibres in compression may count as nothing.
class FibreLoad {
 public:
  explicit FibreLoad(const DispersedFibres& m)
      : m_(m), density_(wall::VonMises{m.concentration, (1.0 / norm(m.mean_direction)) * m.mean_direction}) {}

  double operator()(const Vec3<double>& N, double strain) const {
    if (m_.tension_only && strain <= 0.0) return 0.0;
    return wall::density(density_, N) * m_.k1 * strain * std::exp(m_.k2 * strain * strain);
  }

 private:
  const DispersedFibres& m_;
  wall::Density density_;
};

/// About the mean direction e3 everything depends on N3 alone; the strain changes its sign at one N3.
double extension_stress(const DispersedFibres& m, double stretch) {
  const FibreLoad load(m);
  const double along = stretch * stretch, across = 1.0 / stretch;
  const auto fibres = [&](double N3) {
    const double square = N3 * N3;
    const Vec3<double> N{{std::sqrt(1.0 - square), 0.0, N3}};
    const double strain = along * square + across * (1.0 - square) - 1.0;
    return 2.0 * load(N, strain) * (along * square - 0.5 * across * (1.0 - square));
  };
  const double kink = std::sqrt((1.0 - across) / (along - across));
  return m.shear_modulus * (along - across) +
         DispersedFibres::families * (integral(fibres, 0.0, kink) + integral(fibres, kink, 1.0));
}

/// N = (s cos, N2, s sin) with s^2 = 1 - N2^2: the strain c s^2 sin (c sin + 2 cos) changes its sign with the angle
/// alone.
double shear_stress(const DispersedFibres& m, double c) {
  const FibreLoad load(m);
  const auto ring = [&](double angle) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    return integral(
        [&](double N2) {
          const double square = 1.0 - N2 * N2, s = std::sqrt(square);
          const double strain = c * square * sine * (c * sine + 2.0 * cosine);
          return 2.0 * load({{s * cosine, N2, s * sine}}, strain) * square * (cosine * sine + c * sine * sine);
        },
        -1.0, 1.0);
  };
  const double kink = std::numbers::pi - std::atan2(2.0, c);
  const double half_sphere = integral(ring, 0.0, kink) + integral(ring, kink, std::numbers::pi);
  return m.shear_modulus * c + DispersedFibres::families * half_sphere / (2.0 * std::numbers::pi);
}

}  // namespace

wall::DfdParameters DispersedFibres::parameters() const {
  wall::DfdParameters p;
  p.elastic.shear_modulus = shear_modulus;
  p.elastic.bulk_modulus = bulk_modulus;
  p.options.tension_only = tension_only;
  p.rule = wall::dfd::Octahedral{256};
  p.families.resize(families);
  for (auto& family : p.families) {
    family.energy = {k1, k2};
    family.orientation = wall::dfd::Symmetric{concentration, {}, mean_direction};
  }
  return p;
}

std::string CubeCase::name() const {
  return fmt::format("mu {:g} kPa ({})", 1e-3 * material.shear_modulus,
                     material.tension_only ? "tension only" : "all fibres");
}

std::vector<double> CubeCase::loads() const {
  constexpr int steps = 40;
  std::vector<double> values;
  for (int k = 1; k <= steps; ++k)
    values.push_back(loading == CubeLoading::extension ? 1.0 + 0.2 * k / steps : 0.5 * k / steps);
  return values;
}

std::vector<CubeCase> cube_cases() {
  const double half = std::sqrt(0.5);
  const Vec3<double> e3{{0.0, 0.0, 1.0}}, compressed{{half, 0.0, -half}};
  std::vector<CubeCase> cases;
  for (const double mu : {50e3, 100e3})
    for (const bool tension_only : {true, false})
      cases.push_back({CubeLoading::extension, {mu, 2.5e8, 8e3, 12.0, 3.0, e3, tension_only}});
  for (const bool tension_only : {true, false})
    cases.push_back({CubeLoading::shear, {100e3, 2.5e10, 80e3, 12.0, 3.0, compressed, tension_only}});
  return cases;
}

double analytic_stress(const CubeCase& c, double load) {
  return c.loading == CubeLoading::extension ? extension_stress(c.material, load) : shear_stress(c.material, load);
}

}  // namespace tunica::stages
