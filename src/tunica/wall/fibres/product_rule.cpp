#include <algorithm>
#include <cmath>
#include <numbers>

#include "tunica/wall/fibres/directions.hpp"
#include "tunica/wall/fibres/gauss_rule.hpp"

namespace tunica::wall {

namespace {

using Direction = Vec3<double>;
using std::numbers::pi;

// A weight below exp(-46) of its peak is below rounding. A measure resolves every rule of up to 128 points: its points
// lie densest at the ends, as those of the rule do.
constexpr double negligible = 46.0;
constexpr int panels = 24;

/// exp(2 b (t^2 - 1)) on 0 < t <= 1, t the cosine to the mean direction.
Quadrature symmetric_measure(double b) {
  Quadrature m = composite_rule(
      0.0, std::acos(std::sqrt(std::max(0.0, 1.0 - negligible / std::max(2.0 * b, negligible)))), panels);
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    const double t = std::cos(m.points[i]);
    m.weights[i] *= std::sin(m.points[i]) * std::exp(2.0 * b * (t * t - 1.0));
    m.points[i] = t;
  }
  return m;
}

/// rho_op cos(Theta) dTheta = exp(-2 b s^2) ds on 0 < s <= 1, s = sin(Theta).
Quadrature elevation_measure(double b) {
  Quadrature m =
      composite_rule(0.0, std::asin(std::min(1.0, std::sqrt(negligible / std::max(2.0 * b, negligible)))), panels);
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    const double s = std::sin(m.points[i]);
    m.weights[i] *= std::cos(m.points[i]) * std::exp(-2.0 * b * s * s);
    m.points[i] = s;
  }
  return m;
}

/// Angles from the mean in the half circle, symmetric to it, for the density exp(a cos 2 phi). Equidistant ones as long
/// as they resolve the density (its harmonics fall like I_n(a)): kinks of the stress then make the least error. Fewer
/// are a Gauss rule in cos(2 phi), mirrored, exact for the trigonometric polynomials of degree `count` - 1 in 2 phi
/// times the density; an odd count has a point at the mean itself (Gauss-Radau).
Quadrature in_plane_rule(double a, int count) {
  constexpr double resolved = 1e-6, largest = 50.0;  // beyond the latter it takes some 60 points
  if (a <= largest && std::cyl_bessel_i(count - 1.0, a) <= resolved * std::cyl_bessel_i(0.0, a)) {
    Quadrature rule;
    for (int j = 0; j < count; ++j) {
      rule.points.push_back(pi * (j + 0.5) / count - 0.5 * pi);
      rule.weights.push_back(std::exp(a * (std::cos(2.0 * rule.points.back()) - 1.0)));
    }
    return rule;
  }
  Quadrature m =
      composite_rule(0.0, 2.0 * std::asin(std::min(1.0, std::sqrt(0.5 * negligible / std::max(a, 1e-300)))), panels);
  double mass = 0.0;
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    const double c = std::cos(m.points[i]);
    m.weights[i] *= std::exp(a * (c - 1.0));
    mass += m.weights[i];
    m.points[i] = c;
  }
  const bool odd = count % 2 == 1;
  double scale = 1.0;
  if (odd) {
    double reduced = 0.0;
    for (std::size_t i = 0; i < m.points.size(); ++i) reduced += m.weights[i] *= 1.0 - m.points[i];
    scale = reduced / mass;
  }
  const Quadrature half = gauss_rule(m, count / 2);
  Quadrature rule;
  double rest = 1.0;
  for (std::size_t i = 0; i < half.points.size(); ++i) {
    const double weight = odd ? scale * half.weights[i] / (1.0 - half.points[i]) : half.weights[i];
    for (const double side : {-0.5, 0.5}) {
      rule.points.push_back(side * std::acos(half.points[i]));
      rule.weights.push_back(0.5 * weight);
    }
    rest -= weight;
  }
  if (odd) {
    rule.points.push_back(0.0);
    rule.weights.push_back(rest);
  }
  return rule;
}

/// Rings about the mean direction. Since N and -N are one fibre, what remains after the azimuth is even in t: the
/// positive half of a rule on [-1, 1] is exact to twice the degree of one on [0, 1]. Every other ring is turned by half
/// a step, so that the errors of the azimuth cancel.
DirectionSet product(const VonMises& d, int across, int around) {
  const Direction M = d.mean_direction;
  // e3, so that the rule turns with a mean direction in the plane of the wall.
  const Direction reference = std::abs(M[2]) < 0.9 ? Direction{{0.0, 0.0, 1.0}} : Direction{{1.0, 0.0, 0.0}};
  const Direction projected = reference - dot(reference, M) * M, first = (1.0 / norm(projected)) * projected;
  const Direction second = cross(M, first);
  const Quadrature rings = even_gauss_rule(symmetric_measure(d.concentration), 2 * across);
  DirectionSet set;
  for (std::size_t i = 0; i < rings.points.size(); ++i) {
    const double t = rings.points[i], radius = std::sqrt((1.0 - t) * (1.0 + t)), start = i % 2 == 0 ? 0.5 : 0.0;
    for (int j = 0; j < around; ++j) {
      const double azimuth = 2.0 * pi * (j + start) / around;
      set.directions.push_back(t * M + (radius * std::cos(azimuth)) * first + (radius * std::sin(azimuth)) * second);
      set.weights.push_back(2.0 * rings.weights[i] / around);
    }
  }
  return set;
}

/// Points in sin(Theta) >= 0 of `across` rows on both sides of the plane; they make about half the error of points in
/// Theta. Fibres that carry tension only have a kink in the plane itself when they are sheared out of it. A density
/// that is narrow there is therefore integrated from the plane outwards, on each side by half of the points; a broad
/// one, whose tails count more, by one rule for both sides.
Quadrature elevation_rule(double b, int across) {
  constexpr double narrow = 7.0;  // least directions for k2 = 0 ... 50, a = 0 ... 5
  Quadrature measure = elevation_measure(b);
  if (b < narrow || across % 2 == 1) return even_gauss_rule(measure, across);
  for (double& s : measure.points) s = 2.0 * s - 1.0;
  Quadrature rule = gauss_rule(measure, across / 2);
  for (double& s : rule.points) s = 0.5 * (s + 1.0);
  return rule;
}

/// Elevations times in-plane angles. Turning every other row by half a step was measured to enlarge the error.
DirectionSet product(const BivariateVonMises& d, int across, int around) {
  const Quadrature rows = elevation_rule(d.out_of_plane, across);
  const Quadrature angles = in_plane_rule(d.in_plane, around);
  DirectionSet set;
  for (std::size_t i = 0; i < rows.points.size(); ++i)
    for (const double side : {1.0, -1.0}) {
      const double s = rows.points[i], radius = std::sqrt((1.0 - s) * (1.0 + s));
      if (s == 0.0 && side < 0.0) continue;
      for (std::size_t j = 0; j < angles.points.size(); ++j) {
        const double phi = angles.points[j] + d.mean_angle;
        set.directions.push_back({{radius * std::cos(phi), radius * std::sin(phi), side * s}});
        set.weights.push_back(rows.weights[i] * angles.weights[j]);
      }
    }
  return set;
}

}  // namespace

DirectionSet product_rule(const Density& d, int across, int around) {
  DirectionSet set = std::visit([&](const auto& kind) { return product(kind, across, around); }, d);
  double sum = 0.0;
  for (const double weight : set.weights) sum += weight;
  for (double& weight : set.weights) weight /= sum;
  return set;
}

}  // namespace tunica::wall
