#include "tunica/fitting/vessel.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tunica::fitting {

namespace {

using Pair = std::array<double, 2>;

/// Cauchy stress of a sheet in the fibre frame at these stretches.
std::optional<Pair> cauchy(const wall::Law& law, const Pair& stretch) {
  if (!(stretch[0] > 0.05 && stretch[1] > 0.05)) return std::nullopt;
  const auto S =
      wall::sheet_stress(law, wall::ConstantFrame{}.frame(), stretch[0] * stretch[0], stretch[1] * stretch[1], 0.0);
  if (!S) return std::nullopt;
  return Pair{stretch[0] * stretch[0] * (*S)[0], stretch[1] * stretch[1] * (*S)[1]};
}

/// d sigma_i / d ln lambda_j, the Hessian of the energy in logarithmic strain.
std::optional<Eigen::Matrix2d> moduli(const wall::Law& law, const Pair& stretch) {
  constexpr double step = 1e-5;
  Eigen::Matrix2d M;
  for (int j = 0; j < 2; ++j) {
    Pair more = stretch, less = stretch;
    more[static_cast<std::size_t>(j)] *= std::exp(step);
    less[static_cast<std::size_t>(j)] *= std::exp(-step);
    const auto high = cauchy(law, more), low = cauchy(law, less);
    if (!high || !low) return std::nullopt;
    for (int i = 0; i < 2; ++i)
      M(i, j) = ((*high)[static_cast<std::size_t>(i)] - (*low)[static_cast<std::size_t>(i)]) / (2.0 * step);
  }
  return M;
}

/// From `stretch`, which is close, to the load.
std::optional<Pair> loaded(const wall::Law& law, Pair stretch, const SheetLoad& load) {
  constexpr int most_steps = 40;
  constexpr double longest = 0.05, enough = 1e-8;
  for (int step = 0; step < most_steps; ++step) {
    const auto stress = cauchy(law, stretch);
    const auto M = moduli(law, stretch);
    if (!stress || !M) return std::nullopt;
    const Eigen::Vector2d missing(load[0] - (*stress)[0], load[1] - (*stress)[1]);
    if (missing.norm() <= enough * wall::shear_modulus_at_rest(law)) return stretch;
    Eigen::Vector2d change = M->fullPivLu().solve(missing);
    if (!change.allFinite()) return std::nullopt;
    const double size = change.cwiseAbs().maxCoeff();
    if (size > longest) change *= longest / size;
    for (std::size_t i = 0; i < 2; ++i) stretch[i] *= std::exp(change(static_cast<Eigen::Index>(i)));
  }
  return std::nullopt;
}

}  // namespace

std::optional<VesselPoint> vessel_point(const wall::Law& law, const SheetLoad& load) {
  constexpr int steps = 8;
  Pair stretch{1.0, 1.0};
  for (int k = 1; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const auto next = loaded(law, stretch, {share * load[0], share * load[1]});
    if (!next) return std::nullopt;
    stretch = *next;
  }
  const auto M = moduli(law, stretch);
  if (!M) return std::nullopt;
  return VesselPoint{stretch, {(*M)(0, 0), (*M)(1, 1), (*M)(0, 1)}};
}

std::optional<std::array<double, 2>> not_convex_at(const wall::Law& law, const std::array<double, 2>& largest) {
  constexpr int places = 12;
  constexpr double rounding = -1e-6;
  for (int sum = 0; sum <= 2 * places; ++sum)  // from rest outwards
    for (int i = std::max(0, sum - places); i <= std::min(sum, places); ++i) {
      const auto at = [&](int place, double most) { return 1.0 + (most - 1.0) * place / places; };
      const Pair stretch{at(i, largest[0]), at(sum - i, largest[1])};
      const auto M = moduli(law, stretch);
      if (!M) continue;
      const Eigen::Vector2d values =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(0.5 * (*M + M->transpose())).eigenvalues();
      if (values(0) < rounding * values.cwiseAbs().maxCoeff()) return stretch;
    }
  return std::nullopt;
}

std::array<std::optional<double>, 2> tested_stretch(const std::vector<Protocol>& protocols) {
  std::array<std::optional<double>, 2> largest{};
  const auto note = [&](const Vec3<double>& axis, double stretch) {
    for (int i = 0; i < 2; ++i) {
      constexpr double parallel = 0.99;
      if (std::abs(axis[i]) < parallel) continue;
      auto& most = largest[static_cast<std::size_t>(i)];
      most = std::max(most.value_or(1.0), stretch);
    }
  };
  for (const Protocol& p : protocols) {
    if (p.loading == Loading::simple_shear) continue;
    for (const Row& row : p.rows) {
      note(p.axes.e1, row.along);
      if (row.across) note(p.axes.e2, *row.across);
      if (row.F) note(p.axes.e2, std::hypot((*row.F)(0, 1), (*row.F)(1, 1)));
    }
  }
  return largest;
}

}  // namespace tunica::fitting
