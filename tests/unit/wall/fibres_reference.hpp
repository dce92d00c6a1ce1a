// What the tests of fibre directions compare with: tables, the direction set of the tables, a plain sum of the stress.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "folders.hpp"
#include "tunica/wall/fibres/directions.hpp"

namespace tunica::wall::test {

inline Density isotropic() { return VonMises{}; }

/// Columns by name, empty when the file is absent.
inline std::map<std::string, std::vector<double>> read_table(const std::string& name) {
  std::ifstream file(std::filesystem::path(TUNICA_SHARED_DATA) / "analytic" / name);
  std::map<std::string, std::vector<double>> table;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream cells(line);
    std::size_t column = 0;
    const bool heading = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (heading)
        names.push_back(cell);
      else
        table[names.at(column)].push_back(std::stod(cell));
    }
  }
  return table;
}

inline double sum(const DirectionSet& set) {
  double total = 0.0;
  for (const double w : set.weights) total += w;
  return total;
}

inline double second_moment(const DirectionSet& set, int i, int j) {
  double total = 0.0;
  for (std::size_t n = 0; n < set.weights.size(); ++n)
    total += set.weights[n] * set.directions[n][i] * set.directions[n][j];
  return total;
}

/// The octahedral set with the densities of the reference tables: each triangle is split `splits` times more, and the
/// density in the middle of each part is taken times its solid angle. The tables have splits = 4.
inline DirectionSet midpoint_octahedral(const Density& d, int count, int splits) {
  using Corner = Vec3<double>;
  using Triangle = std::array<Corner, 3>;
  const auto unit = [](const Corner& a) { return (1.0 / norm(a)) * a; };
  const auto split = [&](const std::vector<Triangle>& all) {
    std::vector<Triangle> parts;
    for (const auto& [A, B, C] : all) {
      const Corner AB = unit(A + B), BC = unit(B + C), CA = unit(C + A);
      parts.insert(parts.end(), {{A, AB, CA}, {AB, B, BC}, {CA, BC, C}, {AB, BC, CA}});
    }
    return parts;
  };
  const Corner e1{{1.0, 0.0, 0.0}}, e2{{0.0, 1.0, 0.0}}, e3{{0.0, 0.0, 1.0}};
  std::vector<Triangle> triangles{{e1, e2, e3}, {e2, -1.0 * e1, e3}, {-1.0 * e1, -1.0 * e2, e3}, {-1.0 * e2, e1, e3}};
  while (static_cast<int>(triangles.size()) < count) triangles = split(triangles);
  DirectionSet set;
  for (const Triangle& triangle : triangles) {
    std::vector<Triangle> parts{triangle};
    for (int s = 0; s < splits; ++s) parts = split(parts);
    double weight = 0.0;
    for (const auto& [A, B, C] : parts) {
      const double solid_angle = 2.0 * std::atan2(dot(A, cross(B, C)), 1.0 + dot(A, B) + dot(B, C) + dot(C, A));
      weight += density(d, unit(A + B + C)) * solid_angle / (2.0 * std::numbers::pi);
    }
    set.directions.push_back(unit(triangle[0] + triangle[1] + triangle[2]));
    set.weights.push_back(weight);
  }
  return set;
}

/// S = 2 sum rho f' N x N for k1 = 1, isochoric F.
inline Mat3<double> fibre_stress(const DirectionSet& set, const Mat3<double>& F, double k2, bool tension_only) {
  Mat3<double> S{};
  for (std::size_t n = 0; n < set.weights.size(); ++n) {
    const Vec3<double> N = set.directions[n], x = F * N;
    const double E = dot(x, x) - 1.0;
    if (tension_only && E <= 0.0) continue;
    const double f = 2.0 * set.weights[n] * E * std::exp(k2 * E * E);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) S(i, j) += f * N[i] * N[j];
  }
  return S;
}

inline double size(const Mat3<double>& a) { return std::sqrt(double_dot(a, a)); }

}  // namespace tunica::wall::test
