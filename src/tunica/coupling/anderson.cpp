#include "tunica/coupling/anderson.hpp"

#include <cmath>

#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

/// Solves A c = b, A symmetric and positive [n][n], by Cholesky's method in place. A share of the trace is added to the
/// diagonal, since differences of points may be nearly parallel.
std::vector<double> solve(std::vector<double> A, std::vector<double> b) {
  const std::size_t n = b.size();
  double trace = 0.0;
  for (std::size_t i = 0; i < n; ++i) trace += A[i * n + i];
  for (std::size_t i = 0; i < n; ++i) A[i * n + i] += 1e-12 * trace;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k)
      for (std::size_t i = j; i < n; ++i) A[i * n + j] -= A[i * n + k] * A[j * n + k];
    const double diagonal = std::sqrt(A[j * n + j]);
    for (std::size_t i = j; i < n; ++i) A[i * n + j] /= diagonal;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= A[i * n + k] * b[k];
    b[i] /= A[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= A[k * n + i] * b[k];
    b[i] /= A[i * n + i];
  }
  return b;
}

}  // namespace

std::vector<double> Anderson::coefficients() const {
  const std::size_t n = points_.size() - 1;
  const std::vector<double>& m = points_.back().measure;
  std::vector<double> sums(n * n + n, 0.0);  // dm_i . dm_j, then dm_i . m
  for (std::size_t k = 0; k < m.size(); ++k)
    for (std::size_t i = 0; i < n; ++i) {
      const double d = points_[i + 1].measure[k] - points_[i].measure[k];
      for (std::size_t j = 0; j < n; ++j) sums[i * n + j] += d * (points_[j + 1].measure[k] - points_[j].measure[k]);
      sums[n * n + i] += d * m[k];
    }
  parallel::global_sum(comm_, sums);
  const auto end_of_matrix = sums.begin() + static_cast<std::ptrdiff_t>(n * n);
  std::vector<double> c = solve({sums.begin(), end_of_matrix}, {end_of_matrix, sums.end()});
  for (const double value : c)
    if (!std::isfinite(value)) return std::vector<double>(n, 0.0);  // equal points tell nothing
  return c;
}

std::vector<double> Anderson::next(const std::vector<double>& x, const std::vector<double>& g,
                                   const std::vector<double>& measure, double share) {
  points_.push_back({x, g, measure});
  if (points_.size() > memory_ + 1) points_.pop_front();
  const std::vector<double> c = coefficients();
  std::vector<double> result(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    result[k] = x[k] + share * g[k];
    for (std::size_t j = 0; j < c.size(); ++j)
      result[k] -= c[j] * (points_[j + 1].x[k] - points_[j].x[k] + share * (points_[j + 1].g[k] - points_[j].g[k]));
  }
  return result;
}

}  // namespace tunica::coupling
