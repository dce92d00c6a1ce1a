#include "tunica/fitting/least_squares.hpp"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tunica/base/error.hpp"
#include "tunica/fitting/bounded_step.hpp"

namespace tunica::fitting {

namespace {

// Of central differences: the cube root of rounding balances both errors of a function computed to about 1e-12.
constexpr double difference = 1e-5;

enum class Difference { central, one_sided };

/// The column of dr/dx for one unknown; false where a residual is missing on both sides.
bool differentiate(const Residuals& residuals, std::vector<double>& x, std::size_t i,
                   const std::vector<double>& residuals_at_x, Difference kind, std::vector<double>& column) {
  const double middle = x[i];
  std::vector<double> high, low;
  const auto at = [&](double value, std::vector<double>& r) {
    x[i] = value;
    const bool found = value >= 0.0 && value <= 1.0 && residuals(x, r);
    x[i] = middle;
    return found;
  };
  const bool has_high = at(middle + difference, high),
             has_low = !(has_high && kind == Difference::one_sided) && at(middle - difference, low);
  if (!has_high && !has_low) return false;
  const std::vector<double>&upper = has_high ? high : residuals_at_x, &lower = has_low ? low : residuals_at_x;
  const double step = (has_high ? difference : 0.0) + (has_low ? difference : 0.0);
  column.resize(upper.size());
  for (std::size_t k = 0; k < upper.size(); ++k) column[k] = (upper[k] - lower[k]) / step;
  return true;
}

class Cost : public ceres::CostFunction {
 public:
  Cost(const Residuals& residuals, std::size_t count, std::size_t unknowns, const std::vector<bool>& held)
      : residuals_(residuals), unknowns_(unknowns), held_(held) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns));
  }

  bool Evaluate(double const* const* blocks, double* values, double** jacobians) const override {
    std::vector<double> x(blocks[0], blocks[0] + unknowns_), r, column;
    if (!residuals_(x, r)) return false;
    std::copy(r.begin(), r.end(), values);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    for (std::size_t i = 0; i < unknowns_; ++i) {
      if (held_[i])
        column.assign(r.size(), 0.0);
      else if (!differentiate(residuals_, x, i, r, Difference::central, column))
        return false;
      for (std::size_t k = 0; k < r.size(); ++k) jacobians[0][k * unknowns_ + i] = column[k];
    }
    return true;
  }

 private:
  const Residuals& residuals_;
  std::size_t unknowns_;
  const std::vector<bool>& held_;
};

}  // namespace

Minimum minimise(const Residuals& residuals, std::vector<double> start, const SearchOptions& options) {
  const std::size_t n = start.size();
  const std::vector<bool> held = options.held.empty() ? std::vector<bool>(n, false) : options.held;
  Minimum result;
  std::vector<double> first;
  if (!residuals(start, first)) throw SolverError("the law has no stress at the starting values of the fit");
  result.x = std::move(start);
  const bool any_free = std::find(held.begin(), held.end(), false) != held.end();
  if (any_free) {
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(residuals, first.size(), n, held), nullptr, result.x.data());
    std::vector<int> constant;
    for (std::size_t i = 0; i < n; ++i) {
      problem.SetParameterLowerBound(result.x.data(), static_cast<int>(i), 0.0);
      problem.SetParameterUpperBound(result.x.data(), static_cast<int>(i), 1.0);
      if (held[i]) constant.push_back(static_cast<int>(i));
    }
    if (!constant.empty())
      problem.SetManifold(result.x.data(), new ceres::SubsetManifold(static_cast<int>(n), constant));
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.max_num_iterations = options.most_iterations;
    solver.function_tolerance = options.tolerance;
    solver.parameter_tolerance = 1e-10;
    solver.gradient_tolerance = 1e-14;
    solver.logging_type = ceres::SILENT;
    solver.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    result.converged = summary.termination_type == ceres::CONVERGENCE;
    result.iterations = static_cast<int>(summary.iterations.size());
  } else {
    result.converged = true;
  }
  for (double& x : result.x) x = std::clamp(x, 0.0, 1.0);
  if (!residuals(result.x, result.residuals)) throw SolverError("the law has no stress where the fit has ended");
  for (const double r : result.residuals) result.squares += r * r;
  return result;
}

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A refit on its way.
class Refit {
 public:
  Refit(const Residuals& residuals, std::vector<double> start, std::vector<double>& J, std::vector<bool> held)
      : residuals_(residuals), J_(J), held_(std::move(held)), at_{.x = std::move(start)} {
    if (!residuals_(at_.x, at_.residuals)) throw SolverError("the law has no stress where a refit starts");
    at_.squares = column(at_.residuals).squaredNorm();
  }

  Minimum run(double enough, bool thorough) {
    fresh_ = thorough;
    const int most_steps = thorough ? 30 : 12;  // one of hundreds need not be exact
    for (; at_.iterations < most_steps; ++at_.iterations) {
      const Matrix normal = slopes().transpose() * slopes();
      const Eigen::VectorXd gradient = slopes().transpose() * column(at_.residuals);
      const Eigen::VectorXd step = unit_step(normal, gradient);
      const double promised = -2.0 * gradient.dot(step) - step.dot(normal * step);
      at_.converged = promised < enough && (fresh_ || !thorough);
      if (at_.converged) break;
      const bool was_fresh = fresh_;
      if (promised >= enough && goes_down(step)) continue;
      if (was_fresh) break;
      J_ = jacobian(residuals_, at_.x, held_);
      fresh_ = true;
    }
    return std::move(at_);
  }

 private:
  using Column = Eigen::Map<const Eigen::VectorXd>;
  static Column column(const std::vector<double>& r) { return {r.data(), static_cast<Eigen::Index>(r.size())}; }
  Eigen::Map<Matrix> slopes() {
    return {J_.data(), static_cast<Eigen::Index>(at_.residuals.size()), static_cast<Eigen::Index>(at_.x.size())};
  }

  Eigen::VectorXd unit_step(const Matrix& normal, const Eigen::VectorXd& gradient) const {
    const std::size_t n = at_.x.size();
    const auto step = bounded_step({normal.data(), n * n}, {gradient.data(), n}, at_.x,
                                   {std::vector<double>(n, 0.0), std::vector<double>(n, 1.0)}, held_);
    return column(step);
  }

  /// Takes the step, or a half, a quarter, an eighth of it, if the squares fall; J learns from every trial.
  bool goes_down(Eigen::VectorXd step) {
    std::vector<double> x(at_.x.size()), r;
    for (int halving = 0; halving < 4; ++halving, step *= 0.5) {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = std::clamp(at_.x[i] + step(static_cast<Eigen::Index>(i)), 0.0, 1.0);
      if (!residuals_(x, r)) continue;
      const Eigen::VectorXd moved = column(x) - column(at_.x);
      const double length = moved.squaredNorm();
      if (!(length > 0.0)) return false;
      const Eigen::VectorXd change = column(r) - column(at_.residuals);
      slopes() += (change - slopes() * moved) * moved.transpose() / length;
      fresh_ = false;
      const double squares = column(r).squaredNorm();
      if (!(squares < at_.squares)) continue;
      at_.squares = squares;
      at_.x.swap(x);
      at_.residuals.swap(r);
      return true;
    }
    return false;
  }

  const Residuals& residuals_;
  std::vector<double>& J_;
  std::vector<bool> held_;
  Minimum at_;
  bool fresh_ = false;  ///< is J that of this place?
};

}  // namespace

Minimum refit(const Residuals& residuals, std::vector<double> start, std::vector<double>& J, double enough,
              const RefitOptions& options) {
  std::vector<bool> held = options.held.empty() ? std::vector<bool>(start.size(), false) : options.held;
  return Refit(residuals, std::move(start), J, std::move(held)).run(enough, options.thorough);
}

std::vector<double> jacobian(const Residuals& residuals, std::span<const double> x, const std::vector<bool>& held) {
  std::vector<double> at(x.begin(), x.end()), r, column;
  if (!residuals(at, r)) throw SolverError("the law has no stress at the fitted values");
  std::vector<double> J(r.size() * at.size(), 0.0);
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!held.empty() && held[i]) continue;
    if (!differentiate(residuals, at, i, r, Difference::one_sided, column))
      throw SolverError("the law has no stress beside the fitted values");
    for (std::size_t k = 0; k < r.size(); ++k) J[k * at.size() + i] = column[k];
  }
  return J;
}

std::vector<std::vector<double>> scattered_starts(std::size_t unknowns, std::size_t count) {
  constexpr std::array<int, 24> primes{2,  3,  5,  7,  11, 13, 17, 19, 23, 29, 31, 37,
                                       41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89};
  std::vector<std::vector<double>> starts(count, std::vector<double>(unknowns));
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t i = 0; i < unknowns; ++i) {
      const int base = primes[i % primes.size()];
      double fraction = 1.0, sum = 0.0;
      for (std::size_t k = n + 1; k > 0; k /= static_cast<std::size_t>(base)) {
        fraction /= base;
        sum += fraction * static_cast<double>(k % static_cast<std::size_t>(base));
      }
      starts[n][i] = 0.02 + 0.96 * sum;  // not on a bound
    }
  return starts;
}

}  // namespace tunica::fitting
