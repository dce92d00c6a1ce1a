#include "tunica/fitting/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

namespace {

using wall::PathPoint, wall::StressMeasure;

/// Stress along an edge of stretch `stretch` from S; the edges stay perpendicular and the volume is kept.
double from_second(StressMeasure measure, double S, double stretch) {
  if (measure == StressMeasure::second_piola_kirchhoff) return S;
  return S * (measure == StressMeasure::cauchy ? stretch * stretch : stretch);
}

/// The specimen of one protocol on its way through the rows.
class Machine {
 public:
  Machine(const wall::Law& law, const wall::Volumetric& volumetric, const Protocol& protocol)
      : law_(law),
        volumetric_(volumetric),
        p_(protocol),
        incompressible_(!std::isfinite(volumetric.bulk_modulus)),
        at_(wall::deformed(law, volumetric, identity<double>())) {}

  void append(const Row& row, std::vector<double>& stresses) {
    if (row.F) return append_gradient(*row.F, stresses);
    if (p_.loading == Loading::simple_shear) {
      at_ = wall::sheared(law_, volumetric_, p_.axes, row.along);
      stresses.push_back(wall::stress_component(at_, p_.measure, p_.axes.e1, p_.axes.e2));
      return;
    }
    if (const auto across = stretch_across(row)) {
      if (incompressible_ && append_sheet(row.along, *across, stresses)) return;
      at_ = wall::stretched(law_, volumetric_, p_.axes, {row.along, *across}, at_);
    } else if (p_.load_ratio) {
      at_ = at_load_ratio(row.along);
    } else {
      at_ = wall::stretched(law_, volumetric_, p_.axes, {row.along, std::nullopt}, at_);
    }
    stresses.push_back(wall::stress_component(at_, p_.measure, p_.axes.e1, p_.axes.e1));
    if (p_.second_stress) stresses.push_back(wall::stress_component(at_, p_.measure, p_.axes.e2, p_.axes.e2));
  }

 private:
  /// The sheet as its markers show it; its thickness follows from the volume.
  void append_gradient(const Mat3<double>& F, std::vector<double>& stresses) const {
    if (!incompressible_)
      throw InputError("tests " + p_.name, "holds measured deformation gradients, but the volume of the law may change",
                       "say `incompressible: true`, or give the material `poisson_ratio: 0.5`");
    const double a = F(0, 0), b = F(0, 1), c = F(1, 0), d = F(1, 1);
    const auto S = wall::sheet_stress(law_, p_.axes, a * a + c * c, b * b + d * d, a * b + c * d);
    if (!S) throw SolverError("the sheet would shear across its thickness");
    const double S11 = (*S)[0], S22 = (*S)[1], S12 = (*S)[3];
    std::array<double, 2> along_axes{S11, S22};
    if (p_.measure == StressMeasure::first_piola_kirchhoff) along_axes = {a * S11 + b * S12, c * S12 + d * S22};
    if (p_.measure == StressMeasure::cauchy)
      along_axes = {a * a * S11 + 2.0 * a * b * S12 + b * b * S22, c * c * S11 + 2.0 * c * d * S12 + d * d * S22};
    for (std::size_t k = 0; k < p_.components(); ++k) stresses.push_back(along_axes[k]);
  }

  std::optional<double> stretch_across(const Row& row) const {
    if (p_.loading == Loading::planar) return 1.0;
    return row.across;
  }

  /// False where the closed form does not hold: the sheet would shear across its thickness.
  bool append_sheet(double along, double across, std::vector<double>& stresses) const {
    const auto S = wall::sheet_stress(law_, p_.axes, along * along, across * across, 0.0);
    if (!S) return false;
    stresses.push_back(from_second(p_.measure, (*S)[0], along));
    if (p_.second_stress) stresses.push_back(from_second(p_.measure, (*S)[1], across));
    return true;
  }

  /// The stretch across at which P22 = ratio P11, by the secant method from the last one.
  PathPoint at_load_ratio(double along) const {
    const auto state = [&](double across) { return wall::stretched(law_, volumetric_, p_.axes, {along, across}, at_); };
    const auto excess = [&](const PathPoint& point) {
      const auto P = [&](const Vec3<double>& a) {
        return wall::stress_component(point, StressMeasure::first_piola_kirchhoff, a, a);
      };
      return P(p_.axes.e2) - *p_.load_ratio * P(p_.axes.e1);
    };
    const double scale = wall::shear_modulus_at_rest(law_);
    double before = norm(at_.F * p_.axes.e2), now = before + 1e-3;
    double excess_before = excess(state(before));
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps; ++step) {
      PathPoint point = state(now);
      const double e = excess(point);
      if (std::abs(e) <= 1e-10 * scale) return point;
      const double slope = (e - excess_before) / (now - before);
      if (!(std::abs(slope) > 0.0)) break;
      constexpr double longest = 0.05;
      before = now;
      excess_before = e;
      now -= std::max(-longest, std::min(longest, e / slope));
      if (!(now > 0.05)) break;
    }
    throw SolverError(
        fmt::format("no stretch across gives the load ratio {:.4g} at a stretch of {:.6g}", *p_.load_ratio, along));
  }

  const wall::Law& law_;
  const wall::Volumetric& volumetric_;
  const Protocol& p_;
  bool incompressible_;
  PathPoint at_;
};

}  // namespace

std::vector<double> predicted(const wall::Law& law, const wall::Volumetric& volumetric, const Protocol& protocol) {
  Machine machine(law, volumetric, protocol);
  std::vector<double> stresses;
  stresses.reserve(protocol.values());
  for (const Row& row : protocol.rows) machine.append(row, stresses);
  return stresses;
}

std::vector<double> measured(const Protocol& protocol) {
  std::vector<double> values;
  values.reserve(protocol.values());
  for (const Row& row : protocol.rows)
    for (std::size_t k = 0; k < protocol.components(); ++k) values.push_back(row.stress[k]);
  return values;
}

const char* name_of(Loading loading) {
  constexpr const char* names[] = {"uniaxial", "biaxial", "planar", "simple shear", "measured gradients"};
  return names[static_cast<int>(loading)];
}

}  // namespace tunica::fitting
