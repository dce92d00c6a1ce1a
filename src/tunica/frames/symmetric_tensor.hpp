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

struct Principal {
  Vec3<double> direction;  ///< unit, of the largest eigenvalue; its sign has no meaning
  double largest, second;  ///< eigenvalues
};

/// By Jacobi's rotations: exact for any symmetric tensor, multiple eigenvalues included.
inline Principal principal(const SymmetricTensor& s) {
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
  int first = 0;
  for (int i = 1; i < 3; ++i)
    if (a[i][i] > a[first][first]) first = i;
  const int b = (first + 1) % 3, c = (first + 2) % 3;
  return {{{v[0][first], v[1][first], v[2][first]}}, a[first][first], std::max(a[b][b], a[c][c])};
}

}  // namespace tunica::frames
