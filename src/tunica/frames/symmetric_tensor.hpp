// Sums of dyads and their principal direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tunica/base/tensor.hpp"

namespace tunica::frames {

/// xx, yy, zz, xy, yz, xz.
using SymmetricTensor = std::array<double, 6>;

inline SymmetricTensor dyad(const Vec3<double>& v, double factor) {
  return {factor * v[0] * v[0], factor * v[1] * v[1], factor * v[2] * v[2],
          factor * v[0] * v[1], factor * v[1] * v[2], factor * v[0] * v[2]};
}

struct PrincipalAxes {
  Vec3<double> values;      ///< eigenvalues, largest first
  Mat3<double> directions;  ///< rows: unit vectors, in this order; their signs have no meaning
};

/// By Jacobi's rotations: exact for any symmetric tensor, multiple eigenvalues included.
inline PrincipalAxes principal_axes(const SymmetricTensor& s) {
  double a[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double size = std::abs(s[0]) + std::abs(s[1]) + std::abs(s[2]);
  for (int sweep = 0; sweep < 20 && std::abs(a[0][1]) + std::abs(a[1][2]) + std::abs(a[0][2]) > 1e-15 * size; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
      if (a[p][q] == 0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), d = t * c;
      for (auto& row : a) row[p] = c * row[p] - d * std::exchange(row[q], d * row[p] + c * row[q]);
      for (int k = 0; k < 3; ++k) a[p][k] = c * a[p][k] - d * std::exchange(a[q][k], d * a[p][k] + c * a[q][k]);
      for (auto& row : v) row[p] = c * row[p] - d * std::exchange(row[q], d * row[p] + c * row[q]);
    }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] > a[j][j]; });
  PrincipalAxes result;
  for (int i = 0; i < 3; ++i) {
    result.values[i] = a[order[i]][order[i]];
    for (int k = 0; k < 3; ++k) result.directions(i, k) = v[k][order[i]];
  }
  return result;
}

struct Principal {
  Vec3<double> direction;  ///< unit, of the largest eigenvalue; its sign has no meaning
  double largest, second;  ///< eigenvalues
};

inline Principal principal(const SymmetricTensor& s) {
  const auto axes = principal_axes(s);
  const auto& d = axes.directions;
  return {{{d(0, 0), d(0, 1), d(0, 2)}}, axes.values[0], axes.values[1]};
}

}  // namespace tunica::frames
