#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "tunica/wall/fibres/directions.hpp"
#include "tunica/wall/fibres/gauss_rule.hpp"
#include "tunica/wall/fibres/rule_size.hpp"
#include "tunica/wall/symmetric.hpp"

namespace tunica::wall {

namespace {

using Direction = Vec3<double>;
using Stress = Symmetric<double>;

struct Fibre {
  double k2;
  bool tension_only;

  /// Adds 2 rho f'(E) N x N for k1 = 1, E = C : N x N - 1.
  void add(const Stress& C, const Direction& N, double rho, Stress& S) const {
    const double E = dot(N, C * N) - 1.0;
    if (tension_only && E <= 0.0) return;
    const double f = 2.0 * rho * E * std::exp(k2 * E * E);
    for (int n = 0; n < voigt_size; ++n) S[n] += f * N[voigt_row[n]] * N[voigt_column[n]];
  }
};

Direction mean_direction(const VonMises& d) { return d.mean_direction; }
Direction mean_direction(const BivariateVonMises& d) { return {{std::cos(d.mean_angle), std::sin(d.mean_angle), 0.0}}; }

Mat3<double> dyad(const Direction& a, const Direction& b) {
  Mat3<double> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = a[i] * b[j];
  return r;
}

/// C of isochoric states in the axes m (mean), p (across it), q = e3 for a mean in the plane of the wall: uniaxial
/// to 1.2 along m, p, q and between m and p; equibiaxial to 1.15 in m-p; simple shear of 0.5 in m-p along m both ways
/// and along p, in m-q, and at 45 degrees so that the mean is compressed.
std::vector<Stress> strain_states(const Direction& m) {
  const Direction reference = std::abs(m[2]) < 0.9 ? Direction{{0.0, 0.0, 1.0}} : Direction{{1.0, 0.0, 0.0}};
  const Direction projected = reference - dot(reference, m) * m, q = (1.0 / norm(projected)) * projected,
                  p = cross(q, m);
  const Mat3<double> I = identity<double>();
  const auto stretched = [&](double stretch, const Direction& axis) {  // and the directions across it alike
    const double other = 1.0 / std::sqrt(stretch);
    return other * I + (stretch - other) * dyad(axis, axis);
  };
  const double between = std::sqrt(0.5);
  const Mat3<double> states[] = {stretched(1.2, m),
                                 stretched(1.2, p),
                                 stretched(1.2, q),
                                 stretched(1.2, between * (m + p)),
                                 stretched(1.0 / (1.15 * 1.15), q),
                                 I + 0.5 * dyad(m, p),
                                 I + 0.5 * dyad(p, m),
                                 I + (-0.5) * dyad(m, p),
                                 I + 0.5 * dyad(m, q),
                                 I + (-0.5) * dyad(between * (m + p), between * (m - p))};
  std::vector<Stress> result;
  for (const Mat3<double>& F : states) result.push_back(right_cauchy_green(F));
  // States in axes that no rule has a symmetry with.
  const double oblique[][3] = {{0.80, 0.53, 0.28}, {0.45, -0.25, 0.86}, {-0.33, 0.79, 0.52}};
  for (const auto& [x, y, z] : oblique) {
    const Direction along = x * m + y * p + z * q, across = cross(along, y * m + z * p + x * q);
    const Direction a = (1.0 / norm(along)) * along, b = (1.0 / norm(across)) * across;
    for (const Mat3<double>& F : {stretched(1.2, a), stretched(1.0 / (1.15 * 1.15), a), I + 0.5 * dyad(a, b)})
      result.push_back(right_cauchy_green(F));
  }
  return result;
}

/// Composite Gauss rule in the elevation from the plane across the mean (von Mises) or from the e1-e2 plane, in the
/// interval that holds the density, times a fine trapezoidal one.
DirectionSet reference_set(const Density& d) {
  constexpr int panels = 6, around = 192;
  const auto* symmetric = std::get_if<VonMises>(&d);
  const double b = symmetric ? symmetric->concentration : std::get<BivariateVonMises>(d).out_of_plane;
  const double narrow = 46.0 / std::max(2.0 * b, 46.0);  // squared sine beyond which the density is below rounding
  const Direction pole = symmetric ? symmetric->mean_direction : Direction{{0.0, 0.0, 1.0}};
  const Direction m = symmetric ? (std::abs(pole[0]) < 0.9 ? Direction{{1.0, 0.0, 0.0}} : Direction{{0.0, 1.0, 0.0}})
                                : mean_direction(std::get<BivariateVonMises>(d));
  const Direction projected = m - dot(m, pole) * pole, first = (1.0 / norm(projected)) * projected;
  const Direction second = cross(pole, first);
  const double right_angle = 0.5 * std::numbers::pi, edge = std::asin(std::sqrt(narrow));
  const Quadrature elevations =
      symmetric ? composite_rule(right_angle - edge, right_angle, panels) : composite_rule(0.0, edge, panels);
  DirectionSet set;
  double sum = 0.0;
  for (std::size_t i = 0; i < elevations.points.size(); ++i)
    for (int j = 0; j < around; ++j) {
      const double elevation = elevations.points[i], phi = 2.0 * std::numbers::pi * (j + 0.5) / around;
      const Direction N = (std::cos(elevation) * std::cos(phi)) * first +
                          (std::cos(elevation) * std::sin(phi)) * second + std::sin(elevation) * pole;
      set.directions.push_back(N);
      set.weights.push_back(elevations.weights[i] * std::cos(elevation) * density(d, N));
      sum += set.weights.back();
    }
  for (double& weight : set.weights) weight /= sum;
  return set;
}

/// Error of the fibre stress of direction sets for one density and energy.
class Measure {
 public:
  Measure(const Density& d, double k2, bool tension_only)
      : fibre_{k2, tension_only},
        states_(strain_states(std::visit([](const auto& kind) { return mean_direction(kind); }, d))) {
    const DirectionSet fine = reference_set(d), isotropic = reference_set(VonMises{});
    const Fibre linear{0.0, tension_only};
    for (const Stress& C : states_) {
      reference_.push_back(stress(fibre_, C, fine));
      scale_.push_back(std::max(norm(reference_.back()), norm(stress(linear, C, isotropic))));
    }
  }

  double error(const DirectionSet& set) const {
    double largest = 0.0;
    for (std::size_t n = 0; n < states_.size(); ++n)
      largest = std::max(largest, norm(stress(fibre_, states_[n], set) + (-1.0) * reference_[n]) / scale_[n]);
    return largest;
  }

 private:
  static Stress stress(const Fibre& fibre, const Stress& C, const DirectionSet& set) {
    Stress S{};
    for (std::size_t n = 0; n < set.directions.size(); ++n) fibre.add(C, set.directions[n], set.weights[n], S);
    return S;
  }

  Fibre fibre_;
  std::vector<Stress> states_, reference_;
  std::vector<double> scale_;
};

}  // namespace

RuleChoice measured_rule(DirectionSet set, std::string name, const Density& d, double k2, bool tension_only) {
  const double error = Measure(d, k2, tension_only).error(set);
  return {std::move(set), std::move(name), error};
}

namespace {

struct Candidate {
  int across, around;
};

std::pair<RuleChoice, Candidate> cheapest(const Density& d, double k2, double tolerance, bool tension_only) {
  std::vector<Candidate> ladder;
  for (const int around : {6, 8, 10, 12, 14, 16, 20, 24, 32, 48, 64})
    for (const int across : {2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48}) ladder.push_back({across, around});
  std::stable_sort(ladder.begin(), ladder.end(),
                   [](const Candidate& a, const Candidate& b) { return a.across * a.around < b.across * b.around; });
  const Measure measure(d, k2, tension_only);
  std::optional<std::pair<RuleChoice, Candidate>> best;
  for (const Candidate& c : ladder) {
    DirectionSet set = product_rule(d, c.across, c.around);
    const double error = measure.error(set);
    if (!best || error < best->first.error)
      best = {{std::move(set), fmt::format("product {} x {}", c.across, c.around), error}, c};
    if (best->first.error <= tolerance) break;
  }
  return *best;
}

}  // namespace

RuleChoice choose_rule(const Density& d, double k2, double tolerance, bool tension_only) {
  return cheapest(d, k2, tolerance, tension_only).first;
}

RuleSize choose_rule_size(const Density& d, double k2, double tolerance, bool tension_only) {
  const Candidate c = cheapest(d, k2, tolerance, tension_only).second;
  return {c.across, c.around};
}

}  // namespace tunica::wall
