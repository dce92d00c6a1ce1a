// Tests of a specimen that was never cut: a planar biaxial machine that holds the ratio of two loads, a law with known
// parameters, and noise that is alike in neighbouring rows.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tunica/fitting/protocol.hpp"
#include "tunica/fitting/standard_laws.hpp"
#include "tunica/wall/materials/dfd_directions.hpp"

namespace tunica::test {

struct Noise {
  double stress = 0.0;       ///< standard deviation [Pa]
  double correlation = 0.8;  ///< of one row with the next
  unsigned seed = 1;
};

/// Noise of `rows` rows: x_i = c x_(i-1) + sqrt(1 - c^2) e_i.
inline std::vector<double> correlated(std::size_t rows, const Noise& noise, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, noise.stress);
  std::vector<double> x{noise.stress > 0.0 ? normal(random) : 0.0};
  while (x.size() < rows)
    x.push_back(noise.stress > 0.0 ? noise.correlation * x.back() +
                                         std::sqrt(1.0 - noise.correlation * noise.correlation) * normal(random)
                                   : 0.0);
  return x;
}

/// Stretches of an incompressible sheet at which P = loads [Pa], by Newton's method from `stretch`.
inline std::array<double, 2> loaded_sheet(const wall::Law& law, const std::array<double, 2>& loads,
                                          std::array<double, 2> stretch) {
  const wall::FibreFrame axes = wall::ConstantFrame{}.frame();
  const auto P = [&](double a, double b) {
    const auto S = wall::sheet_stress(law, axes, a * a, b * b, 0.0);
    return std::array<double, 2>{a * (*S)[0], b * (*S)[1]};
  };
  for (int k = 0; k < 60; ++k) {
    constexpr double h = 1e-6;
    const auto at = P(stretch[0], stretch[1]), first = P(stretch[0] + h, stretch[1]),
               second = P(stretch[0], stretch[1] + h);
    const double a = (first[0] - at[0]) / h, b = (second[0] - at[0]) / h, c = (first[1] - at[1]) / h,
                 d = (second[1] - at[1]) / h, e = loads[0] - at[0], f = loads[1] - at[1];
    if (std::hypot(e, f) < 1e-3) break;
    double x = (d * e - b * f) / (a * d - b * c), y = (a * f - c * e) / (a * d - b * c);
    const double longest = std::max(std::abs(x), std::abs(y)), shrink = std::min(1.0, 0.02 / longest);
    stretch[0] += shrink * x;
    stretch[1] += shrink * y;
  }
  return stretch;
}

/// Five load ratios up to `peak` [Pa], first Piola-Kirchhoff stress, as many rows each.
inline std::vector<fitting::Protocol> biaxial_protocols(const wall::Law& law, std::size_t rows, double peak,
                                                        const Noise& noise) {
  constexpr std::array<std::array<double, 2>, 5> ratios{{{1, 1}, {1, 0.75}, {0.75, 1}, {1, 0.5}, {0.5, 1}}};
  std::mt19937 random(noise.seed);
  std::vector<fitting::Protocol> protocols;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    fitting::Protocol p{.specimen = "specimen", .name = "biaxial " + std::to_string(k + 1), .file = "none"};
    p.loading = fitting::Loading::biaxial;
    p.axes = wall::ConstantFrame{}.frame();
    p.second_stress = true;
    const auto along = correlated(rows, noise, random), across = correlated(rows, noise, random);
    std::array<double, 2> stretch{1.0, 1.0};
    for (std::size_t i = 0; i < rows; ++i) {
      const double load = peak * static_cast<double>(i + 1) / static_cast<double>(rows);
      const std::array<double, 2> loads{ratios[k][0] * load, ratios[k][1] * load};
      stretch = loaded_sheet(law, loads, stretch);
      p.rows.push_back({.line = static_cast<int>(i) + 2,
                        .along = stretch[0],
                        .across = stretch[1],
                        .stress = {loads[0] + along[i], loads[1] + across[i]}});
    }
    p.test = "biaxial";
    protocols.push_back(std::move(p));
  }
  return protocols;
}

/// Two families of dispersed fibres about e1. Moduli [kPa], angle [deg].
struct DispersedWall {
  double mu = 61, k1 = 34, k2 = 12.6, angle = 38, a = 2.9, b = 19.44;
  wall::DfdParameters parameters() const {
    wall::DfdParameters p;
    p.elastic = {.shear_modulus = 1e3 * mu, .poisson_ratio = 0.5};
    for (const double side : {1.0, -1.0}) {
      wall::dfd::Family family;
      family.energy = {1e3 * k1, k2};
      family.orientation = wall::dfd::Bivariate{a, b, side * angle * std::numbers::pi / 180.0};
      p.families.push_back(family);
    }
    return p;
  }
  /// In SI units, in the order of the standard law: shear modulus, k1, k2, angle, a, b.
  std::vector<double> values() const { return {1e3 * mu, 1e3 * k1, k2, angle * std::numbers::pi / 180.0, a, b}; }
  wall::Law law() const { return wall::law_with(parameters(), {10, 32}); }
};

}  // namespace tunica::test
