#include "tunica/wall/fibres/directions.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace tunica::wall {

namespace {

using Direction = Vec3<double>;

struct Triangle {
  Direction A, B, C;

  /// At the corners A, B, C and in the middle; edges are halved on the sphere.
  std::array<Triangle, 4> split() const {
    const Direction AB = normalised(A + B), BC = normalised(B + C), CA = normalised(C + A);
    return {{{A, AB, CA}, {AB, B, BC}, {CA, BC, C}, {AB, BC, CA}}};
  }
};

/// Gauss points of an even number n, u and v of the square collapsed into the corner C, where a bivariate density may
/// have no limit; dS = det(A, B, C) / |P|^3 on the flat triangle P = (1-v) ((1-u) A + u B) + v C.
template <unsigned n>
double integral(const Density& d, const Triangle& t) {
  using Gauss = boost::math::quadrature::gauss<double, n>;
  const auto along_v = [&](double v) {
    return (1.0 - v) * Gauss::integrate(
                           [&](double u) {
                             const Direction P = (1.0 - v) * ((1.0 - u) * t.A + u * t.B) + v * t.C;
                             const double r = norm(P);
                             return density(d, (1.0 / r) * P) / (r * r * r);
                           },
                           0.0, 1.0);
  };
  return dot(t.A, cross(t.B, t.C)) * Gauss::integrate(along_v, 0.0, 1.0);
}

/// At a corner in e3 a split into four leaves a triangle of the same angle, in which a bivariate density varies as
/// before. This one halves the angle too.
std::array<Triangle, 6> split_at_pole(const Triangle& t) {
  const Direction AB = normalised(t.A + t.B), A = normalised(t.A + t.C), M = normalised(AB + t.C),
                  B = normalised(t.B + t.C);
  return {{{A, M, t.C}, {M, B, t.C}, {t.A, AB, A}, {AB, M, A}, {AB, t.B, M}, {t.B, B, M}}};
}

/// Integral over the triangle, split until two rules agree: to 1e-15 of all fibres, or as far as rounding allows.
double adaptive_integral(const Density& d, const Triangle& t, int depth) {
  const double fine = integral<8>(d, t), difference = std::abs(fine - integral<6>(d, t));
  if (depth == 0 || difference <= std::max(1e-15, 1e-13 * fine)) return fine;
  double sum = 0.0;
  const auto add = [&](const auto& parts) {
    for (const Triangle& part : parts) sum += adaptive_integral(d, part, depth - 1);
  };
  if (t.C[2] == 1.0)
    add(split_at_pole(t));
  else
    add(t.split());
  return sum;
}

void add_triangles(const Density& d, const Triangle& t, int splits, DirectionSet& set) {
  if (splits > 0) {
    for (const Triangle& part : t.split()) add_triangles(d, part, splits - 1, set);
    return;
  }
  set.directions.push_back(normalised(t.A + t.B + t.C));
  set.weights.push_back(adaptive_integral(d, t, 12) / (2.0 * std::numbers::pi));
}

}  // namespace

bool is_octahedral_size(int count) {
  while (count > 4 && count % 4 == 0) count /= 4;
  return count == 4;
}

DirectionSet octahedral(const Density& d, int count) {
  int splits = 0;
  for (int n = count; n > 4; n /= 4) ++splits;
  const Direction e1{{1.0, 0.0, 0.0}}, e2{{0.0, 1.0, 0.0}}, e3{{0.0, 0.0, 1.0}};
  const Direction ring[] = {e1, e2, -1.0 * e1, -1.0 * e2, e1};
  DirectionSet set;
  set.directions.reserve(static_cast<std::size_t>(count));
  set.weights.reserve(static_cast<std::size_t>(count));
  for (int octant = 0; octant < 4; ++octant) add_triangles(d, {ring[octant], ring[octant + 1], e3}, splits, set);
  return set;
}

void DirectionIndex::add(const Direction& N) {
  by_first_.emplace(std::abs(N[0]), directions_.size());
  directions_.push_back(N);
}

std::optional<std::size_t> DirectionIndex::find(const Direction& N) const {
  constexpr double equal = 1e-12;
  const double key = std::abs(N[0]);
  const auto last = by_first_.upper_bound(key + equal);
  const auto found = std::find_if(by_first_.lower_bound(key - equal), last, [&](const auto& entry) {
    const Direction& other = directions_[entry.second];
    return std::min(norm(other - N), norm(other + N)) <= equal;
  });
  return found == last ? std::nullopt : std::optional(found->second);
}

DirectionSet merge(std::span<const DirectionSet> sets) {
  DirectionSet merged;
  DirectionIndex index;
  for (const DirectionSet& set : sets)
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
      const Direction& N = set.directions[n];
      if (const auto known = index.find(N)) {
        merged.weights[*known] += set.weights[n];
        continue;
      }
      index.add(N);
      merged.directions.push_back(N);
      merged.weights.push_back(set.weights[n]);
    }
  return merged;
}

void degrade(DirectionSet& set, const std::vector<Degradation>& ranges) {
  constexpr double right_angle = 0.5 * std::numbers::pi, rounding = 1e-12;
  for (const Degradation& range : ranges)
    for (std::size_t n = 0; n < set.directions.size(); ++n) {
      const Direction& N = set.directions[n];
      const double angle = std::atan2(std::hypot(N[0], N[1]), std::abs(N[2]));
      if (angle >= range.from && (angle < range.to || range.to >= right_angle - rounding))
        set.weights[n] *= range.factor;
    }
}

}  // namespace tunica::wall
