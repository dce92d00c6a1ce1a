#include "tunica/motion_imaging/surface_motion.hpp"

#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/mesh/boundary.hpp"

namespace tunica::motion_imaging {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entry = Eigen::Triplet<double>;
using geometry::Triangle;
using geometry::TriangleSurface;

constexpr int rounds = 6;                 ///< of looking and moving in each pass, at most
constexpr double by_twicing = 1.28;       ///< deviation after the second pass over that after the first one
constexpr double rest = 0.005;            ///< change of a round over the smoothing length: nothing moves any more
constexpr double of_nothing_else = 4e-3;  ///< weight of |u|^2 over that of the data
constexpr double huber = 2.5;             ///< standard deviations from which on a residual counts less
constexpr double tolerance = 1e-5;        ///< of the linear system
constexpr double of_radius = 0.5;         ///< smoothing length over the radius of a vessel, at most
constexpr double least_length = 1e-3;     ///< however bent it is, as at the rim of a tear [m]
constexpr double least_residual = 0.02;   ///< over the grain: nothing is known better
constexpr int sweeps_nearby = 10;         ///< of the averages over neighbours that make a residual a local one

/// Stiffness of the Laplacian on linear triangles and the area of each point.
std::pair<Sparse, Eigen::VectorXd> laplacian(const TriangleSurface& s) {
  const auto n = static_cast<Eigen::Index>(s.points.size());
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(n);
  std::vector<Entry> entries;
  for (const auto& t : s.triangles) {
    const double twice = 2 * norm(geometry::area_vector(s, t));
    if (!(twice > 0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      mass[a] += twice / 6;
      // The edge bc faces the corner a.
      const auto& x = s.points[static_cast<std::size_t>(a)];
      const double weight =
          0.5 * dot(s.points[static_cast<std::size_t>(b)] - x, s.points[static_cast<std::size_t>(c)] - x) / twice;
      for (const auto& [p, q, value] : {std::tuple{b, b, weight}, {c, c, weight}, {b, c, -weight}, {c, b, -weight}})
        entries.emplace_back(static_cast<int>(p), static_cast<int>(q), value);
    }
  }
  Sparse stiffness(n, n);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return {std::move(stiffness), std::move(mass)};
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What a boundary says of each triangle of a moved surface.
struct Look {
  std::vector<std::optional<double>> distance;  ///< [m]
  std::vector<Vec3<double>> normals;            ///< unit
  std::vector<double> areas;                    ///< m^2
};

Look look(const WallSurface& wall, const TriangleSurface& moved, const LumenBoundary& boundary, double reach) {
  Look result;
  for (std::size_t t = 0; t < moved.triangles.size(); ++t) {
    const auto& corners = moved.triangles[t];
    const auto vector = geometry::area_vector(moved, corners);
    const double size = norm(vector);
    result.areas.push_back(size);
    result.normals.push_back(size > 0 ? (1 / size) * vector : Vec3<double>{});
    result.distance.push_back(
        size > 0 ? boundary.ahead(mesh::centroid(moved.points, corners), result.normals.back(), wall.sides[t], reach)
                 : std::nullopt);
  }
  return result;
}

/// Huber's weights; 0 where nothing was found.
std::vector<double> weights_of(const Look& look) {
  std::vector<double> sizes;
  for (const auto& d : look.distance)
    if (d) sizes.push_back(std::abs(*d));
  const double bound = huber * 1.4826 * median_of(std::move(sizes));
  std::vector<double> weights;
  for (const auto& d : look.distance) weights.push_back(!d ? 0.0 : std::abs(*d) <= bound ? 1.0 : bound / std::abs(*d));
  return weights;
}

TriangleSurface moved_by(const TriangleSurface& surface, const std::vector<Vec3<double>>& displacement) {
  TriangleSurface moved = surface;
  for (std::size_t n = 0; n < displacement.size(); ++n) moved.points[n] = moved.points[n] + displacement[n];
  return moved;
}

}  // namespace

struct WallTracker::Smoother {
  Sparse matrix;               ///< of l^4 |Lap u|^2 + e |u|^2, three unknowns a point
  std::vector<double> length;  ///< l of each point [m]
};

namespace {

/// The smoothing length, and not more than half the radius nearby: widening of a tube is not to be taken for noise.
std::vector<double> lengths_of(const TriangleSurface& surface, const Sparse& stiffness, const Eigen::VectorXd& mass,
                               double smoothing) {
  Eigen::MatrixXd places(mass.size(), 3);
  for (Eigen::Index n = 0; n < mass.size(); ++n)
    for (int d = 0; d < 3; ++d) places(n, d) = surface.points[static_cast<std::size_t>(n)][d];
  // The Laplacian of the place is twice the mean curvature along the normal: that of a tube is one over its radius.
  const Eigen::MatrixXd bent = stiffness * places;
  std::vector<double> curvature, area;
  for (Eigen::Index n = 0; n < mass.size(); ++n) {
    curvature.push_back(bent.row(n).norm());
    area.push_back(mass[n]);
  }
  for (auto* values : {&curvature, &area}) geometry::average_over_neighbours(surface, sweeps_nearby, *values);
  std::vector<double> lengths;
  for (std::size_t n = 0; n < area.size(); ++n) {
    const double radius = curvature[n] > 0 ? area[n] / curvature[n] : std::numeric_limits<double>::infinity();
    lengths.push_back(std::clamp(of_radius * radius, std::min(least_length, smoothing), smoothing));
  }
  return lengths;
}

}  // namespace

WallTracker::WallTracker(WallSurface wall, const MotionSettings& settings)
    : wall_(std::move(wall)), settings_(settings), smoother_(std::make_unique<Smoother>()) {
  auto [stiffness, mass] = laplacian(wall_.surface);
  smoother_->length = lengths_of(wall_.surface, stiffness, mass, settings.smoothing);
  Eigen::VectorXd weight = mass.cwiseMax(1e-3 * mass.mean()).cwiseInverse();
  for (Eigen::Index n = 0; n < weight.size(); ++n)
    weight[n] *= std::pow(smoother_->length[static_cast<std::size_t>(n)], 4);
  const Sparse bending = stiffness * (weight.asDiagonal() * stiffness);
  std::vector<Entry> entries;
  for (int column = 0; column < bending.outerSize(); ++column)
    for (Sparse::InnerIterator it(bending, column); it; ++it)
      for (int d = 0; d < 3; ++d) entries.emplace_back(static_cast<int>(3 * it.row() + d), 3 * column + d, it.value());
  for (Eigen::Index n = 0; n < mass.size(); ++n)
    for (int d = 0; d < 3; ++d)
      entries.emplace_back(static_cast<int>(3 * n + d), static_cast<int>(3 * n + d), of_nothing_else * mass[n]);
  smoother_->matrix.resize(3 * mass.size(), 3 * mass.size());
  smoother_->matrix.setFromTriplets(entries.begin(), entries.end());
}

WallTracker::~WallTracker() = default;
WallTracker::WallTracker(WallTracker&&) noexcept = default;

namespace {

/// Normal equations of the data: w A (n . u - (n . u0 + d))^2, u being the mean of the corners.
std::pair<Sparse, Eigen::VectorXd> data_term(const TriangleSurface& surface, const Look& look,
                                             const std::vector<double>& weights, const Eigen::VectorXd& now) {
  std::vector<Entry> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(now.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const double weight = weights[t] * look.areas[t];
    if (weight == 0) continue;
    const auto& n = look.normals[t];
    std::array<std::pair<Eigen::Index, double>, 9> row;
    double target = *look.distance[t];
    for (std::size_t k = 0; k < 9; ++k) {
      const auto d = static_cast<int>(k % 3);
      row[k] = {3 * surface.triangles[t][k / 3] + d, n[d] / 3};
      target += row[k].second * now[row[k].first];
    }
    for (const auto& [i, a] : row) {
      right[i] += weight * a * target;
      for (const auto& [j, b] : row) entries.emplace_back(static_cast<int>(i), static_cast<int>(j), weight * a * b);
    }
  }
  Sparse matrix(now.size(), now.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return {std::move(matrix), std::move(right)};
}

Eigen::VectorXd solved(const Sparse& matrix, const Eigen::VectorXd& right, const Eigen::VectorXd& guess) {
  Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(tolerance);
  solver.setMaxIterations(5000);
  solver.compute(matrix);
  Eigen::VectorXd result = solver.solveWithGuess(right, guess);
  if (solver.info() != Eigen::Success)
    throw SolverError(
        fmt::format("the motion of the wall was not found: {} iterations leave an error of {:.2g}, {:.2g} "
                    "is due. Check the surface of the mesh for slivers, or choose a smaller `smoothing`",
                    solver.iterations(), solver.error(), tolerance));
  return result;
}

/// Mean square of the residuals about each point, and the share of the area about it that was seen.
std::pair<std::vector<double>, std::vector<double>> scatter(const TriangleSurface& surface, const Look& look) {
  std::vector<double> squares(surface.points.size()), seen(surface.points.size()), all(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const auto n : surface.triangles[t]) {
      const auto at = static_cast<std::size_t>(n);
      all[at] += look.areas[t];
      if (!look.distance[t]) continue;
      seen[at] += look.areas[t];
      squares[at] += look.areas[t] * *look.distance[t] * *look.distance[t];
    }
  for (auto* values : {&squares, &seen, &all}) geometry::average_over_neighbours(surface, sweeps_nearby, *values);
  for (std::size_t n = 0; n < all.size(); ++n) {
    squares[n] = seen[n] > 0 ? squares[n] / seen[n] : 0;
    seen[n] = all[n] > 0 ? seen[n] / all[n] : 0;
  }
  return {std::move(squares), std::move(seen)};
}

Eigen::VectorXd stacked(const std::vector<Vec3<double>>& vectors) {
  Eigen::VectorXd result(3 * std::ssize(vectors));
  for (std::size_t n = 0; n < vectors.size(); ++n)
    for (int d = 0; d < 3; ++d) result[3 * static_cast<Eigen::Index>(n) + d] = vectors[n][d];
  return result;
}

std::vector<Vec3<double>> unstacked(const Eigen::VectorXd& values) {
  std::vector<Vec3<double>> result(static_cast<std::size_t>(values.size() / 3));
  for (std::size_t n = 0; n < result.size(); ++n)
    for (int d = 0; d < 3; ++d) result[n][d] = values[3 * static_cast<Eigen::Index>(n) + d];
  return result;
}

}  // namespace

WallMotion WallTracker::track(const LumenBoundary& boundary, const std::vector<Vec3<double>>& start) const {
  const auto& surface = wall_.surface;
  Eigen::VectorXd now = stacked(start.empty() ? std::vector<Vec3<double>>(surface.points.size()) : start);
  auto moved = moved_by(surface, unstacked(now));
  auto seen = look(wall_, moved, boundary, settings_.reach);
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(now.size());
    if (pass == 1) pull = smoother_->matrix * now;
    for (int round = 0; round < rounds; ++round) {
      const auto [matrix, right] = data_term(surface, seen, weights_of(seen), now);
      const Eigen::VectorXd next = solved(matrix + smoother_->matrix, right + pull, now);
      const double change = (next - now).cwiseAbs().maxCoeff();
      now = next;
      moved = moved_by(surface, unstacked(now));
      seen = look(wall_, moved, boundary, settings_.reach);
      if (change < rest * settings_.smoothing) break;
    }
  }
  WallMotion motion;
  motion.displacement = unstacked(now);
  double area = 0, found = 0, squares = 0;
  for (std::size_t t = 0; t < seen.areas.size(); ++t) {
    area += seen.areas[t];
    if (!seen.distance[t]) continue;
    found += seen.areas[t];
    squares += seen.areas[t] * *seen.distance[t] * *seen.distance[t];
  }
  motion.seen = area > 0 ? found / area : 0;
  motion.residual = found > 0 ? std::sqrt(squares / found) : 0;
  const auto [nearby, share] = scatter(moved, seen);
  const double least = std::pow(least_residual * boundary.grain(), 2);
  for (std::size_t n = 0; n < nearby.size(); ++n) {
    const double reduction = std::min(1.0, by_twicing * boundary.grain() / (4 * smoother_->length[n]));
    motion.deviation.push_back(reduction * std::sqrt(std::max(nearby[n], least) / std::max(share[n], 0.01)));
  }
  return motion;
}

WallMotion difference(const WallMotion& motion, const WallMotion& reference) {
  WallMotion result = motion;
  for (std::size_t n = 0; n < result.displacement.size(); ++n) {
    result.displacement[n] = result.displacement[n] - reference.displacement[n];
    result.deviation[n] = std::hypot(motion.deviation[n], reference.deviation[n]);
  }
  result.seen = std::min(motion.seen, reference.seen);
  return result;
}

}  // namespace tunica::motion_imaging
