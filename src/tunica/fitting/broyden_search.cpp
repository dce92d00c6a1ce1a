#include "tunica/fitting/broyden_search.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tunica/base/limits.hpp"
#include "tunica/fitting/correlation.hpp"

namespace tunica::fitting {

namespace {

using Slopes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double normal_quantile = 1.959964;  ///< 95 %
/// A fall of the squares, in units of their variance, for which no combination of unknowns moves by more than a tenth
/// of its standard deviation.
constexpr double negligible = 1e-2;
/// Of squares by unknowns: what the residuals follow by less than a deviation in a change of three stays where it is.
constexpr double least_damping = 0.1;
constexpr int most_attempts = 4;  ///< at one difference: to either side, and at half the distance
/// Derivatives computed no farther away than that are those of the end.
constexpr double near_slopes = 0.2;

double squares_of(const std::vector<double>& r) {
  double sum = 0;
  for (const double v : r) sum += v * v;
  return sum;
}

double longest_of(const std::vector<double>& d) {
  double longest = 0;
  for (const double v : d) longest = std::max(longest, std::abs(v));
  return longest;
}

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

Eigen::Map<const Eigen::VectorXd> as_column(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

Eigen::Map<const Slopes> as_rows(const std::vector<double>& slopes, std::size_t unknowns) {
  return {slopes.data(), static_cast<Eigen::Index>(slopes.size() / unknowns), static_cast<Eigen::Index>(unknowns)};
}

}  // namespace

BroydenSearch::BroydenSearch(std::vector<double> start, Box bounds, const BroydenOptions& options)
    : bounds_(std::move(bounds)),
      options_(options),
      next_(Query{.x = std::move(start)}),
      radius_(options.longest_step) {}

void BroydenSearch::tell(const std::optional<std::vector<double>>& residuals) {
  if (next_->purpose == Purpose::difference) return told_difference(residuals);
  if (next_->purpose == Purpose::step) return told_step(residuals);
  x_ = next_->x;
  if (!residuals) return finish(SearchEnd::start_failed);
  residuals_ = *residuals;
  squares_ = squares_of(residuals_);
  differentiate();
}

void BroydenSearch::finish(SearchEnd end) {
  end_ = end;
  next_.reset();
}

// --- derivatives ----------------------------------------------------------------------------------------------------

void BroydenSearch::differentiate() {
  unknown_ = 0;
  attempt_ = 0;
  columns_.clear();
  ask_difference();
}

/// To the side where there is room for it; after a failure to the other one, then at half the distance.
void BroydenSearch::ask_difference() {
  const double size = attempt_ < 2 ? options_.difference : 0.5 * options_.difference;
  const double up = std::min(size, bounds_.high[unknown_] - x_[unknown_]),
               down = std::min(size, x_[unknown_] - bounds_.low[unknown_]);
  bool upwards = (up >= down) == (attempt_ % 2 == 0);
  if ((upwards ? up : down) <= 0.1 * size) upwards = !upwards;
  Query query{.x = x_, .purpose = Purpose::difference, .unknown = unknown_};
  query.x[unknown_] += upwards ? up : -down;
  next_ = std::move(query);
}

void BroydenSearch::told_difference(const std::optional<std::vector<double>>& residuals) {
  if (!residuals) {
    if (++attempt_ == most_attempts) return finish(SearchEnd::failing);
    return ask_difference();
  }
  const double step = next_->x[unknown_] - x_[unknown_];
  for (std::size_t k = 0; k < residuals->size(); ++k) columns_.push_back(((*residuals)[k] - residuals_[k]) / step);
  attempt_ = 0;
  if (++unknown_ < x_.size()) return ask_difference();
  const std::size_t rows = residuals_.size(), n = x_.size();
  slopes_.resize(rows * n);
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0; i < n; ++i) slopes_[k * n + i] = columns_[i * rows + k];
  x_of_slopes_ = x_;
  ask_step();
}

/// Broyden's update: the slopes that are nearest to those so far and explain what the move has changed.
void BroydenSearch::follow(const std::vector<double>& moved, const std::vector<double>& residuals) {
  const std::size_t n = x_.size();
  double length = 0;
  for (const double d : moved) length += d * d;
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    double unexplained = residuals[k] - residuals_[k];
    for (std::size_t i = 0; i < n; ++i) unexplained -= slopes_[k * n + i] * moved[i];
    for (std::size_t i = 0; i < n; ++i) slopes_[k * n + i] += unexplained * moved[i] / length;
  }
}

// --- steps ----------------------------------------------------------------------------------------------------------

/// The step of least damping that stays within the radius. The unknowns are alike in size, so that all are damped alike
/// and what the residuals hardly follow stays where it is.
std::vector<double> BroydenSearch::step_within_radius() const {
  const std::size_t n = x_.size();
  const Slopes J = as_rows(slopes_, n);
  const Eigen::VectorXd g = J.transpose() * as_column(residuals_);
  Slopes N = J.transpose() * J;
  double damping = least_damping;
  N.diagonal().array() += damping;
  for (;;) {
    const auto step = bounded_step({N.data(), n * n}, {g.data(), n}, x_, bounds_, std::vector<bool>(n, false));
    if (longest_of(step) <= radius_) return step;
    N.diagonal().array() += 0.5 * damping;
    damping *= 1.5;
  }
}

/// By how much the squares fall if the slopes hold.
double BroydenSearch::promise_of(const std::vector<double>& step) const {
  const Eigen::VectorXd change = as_rows(slopes_, x_.size()) * as_column(step);
  return squares_ - (as_column(residuals_) + change).squaredNorm();
}

void BroydenSearch::ask_step() {
  const auto step = step_within_radius();
  const double spread = static_cast<double>(residuals_.size()) - static_cast<double>(x_.size());
  const double variance = std::max(1.0, spread > 0 ? squares_ / spread : 0.0);
  if (longest_of(step) < options_.tolerance || promise_of(step) < negligible * variance) return arrive();
  Query query{.x = x_, .purpose = Purpose::step};
  for (std::size_t i = 0; i < step.size(); ++i)
    query.x[i] = std::clamp(x_[i] + step[i], bounds_.low[i], bounds_.high[i]);
  next_ = std::move(query);
}

/// With one unknown the last step is the difference of its slope. Where evaluations fail the slopes may have led there.
void BroydenSearch::arrive() {
  const double way = longest_of(less(x_, x_of_slopes_));
  if (failing_ ? way <= options_.tolerance : x_.size() == 1 || way <= near_slopes)
    return finish(failing_ ? SearchEnd::failing : SearchEnd::converged);
  failing_ = false;
  radius_ = std::max(radius_, options_.difference);
  differentiate();
}

void BroydenSearch::told_step(const std::optional<std::vector<double>>& residuals) {
  const auto moved = less(next_->x, x_);
  const double length = longest_of(moved);
  failing_ = !residuals;
  if (failing_) {
    radius_ = length / 3;
    return ask_step();
  }
  const double promised = promise_of(moved), found = squares_of(*residuals);
  follow(moved, *residuals);
  if (found < squares_) {
    const double kept = (squares_ - found) / promised;
    if (kept > 0.5) radius_ = std::clamp(2 * length, radius_, options_.longest_step);
    if (kept < 0.1) radius_ = 0.5 * length;
    x_ = next_->x;
    residuals_ = *residuals;
    squares_ = found;
    return ask_step();
  }
  radius_ = 0.25 * length;
  if (longest_of(less(x_, x_of_slopes_)) > options_.tolerance) return differentiate();
  ask_step();
}

// --- what is determined ---------------------------------------------------------------------------------------------

Estimates estimate(const std::vector<double>& slopes, const std::vector<double>& residuals, std::size_t unknowns,
                   double independent) {
  Estimates result;
  const double left = independent - static_cast<double>(unknowns);
  const double variance = left > 0 ? squares_of(residuals) / left : 0.0;
  result.variance = std::max(1.0, variance);
  result.quantile = variance > 1 ? student_95(left) : normal_quantile;
  const auto n = static_cast<Eigen::Index>(unknowns);
  const Slopes J = as_rows(slopes, unknowns);
  const Eigen::VectorXd norms = J.colwise().norm();
  Eigen::VectorXd scales = norms;
  for (auto& s : scales)
    if (!(s > 0)) s = 1;
  const Slopes scaled = J * scales.cwiseInverse().asDiagonal();
  Eigen::MatrixXd N = scaled.transpose() * scaled;
  N.diagonal().array() += 1e-12;  // one that nothing follows gets a huge variance
  const Eigen::MatrixXd inverse = N.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  result.correlation.assign(unknowns, std::vector<double>(unknowns, 0.0));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double own = std::max(inverse(i, i), 0.0);
    result.deviations.push_back(norms(i) > 0 ? std::sqrt(result.variance * own) / norms(i) : base::infinity);
    for (Eigen::Index j = 0; j < n; ++j)
      result.correlation[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          i == j ? 1.0 : std::clamp(inverse(i, j) / std::sqrt(own * std::max(inverse(j, j), 0.0)), -1.0, 1.0);
  }
  return result;
}

}  // namespace tunica::fitting
