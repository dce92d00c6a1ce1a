#include "tunica/assembly/rank_one.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::assembly {

namespace {

// Inverse of a small dense matrix by Gauss-Jordan elimination with row pivoting; n is the number of outlets.
std::vector<double> dense_inverse(std::vector<double> a, std::size_t n) {
  std::vector<double> inverse(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    if (a[pivot * n + k] == 0.0) throw SolverError("The outlets' capacitance matrix is singular.");
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(a[k * n + j], a[pivot * n + j]);
      std::swap(inverse[k * n + j], inverse[pivot * n + j]);
    }
    const double scale = 1.0 / a[k * n + k];
    for (std::size_t j = 0; j < n; ++j) a[k * n + j] *= scale, inverse[k * n + j] *= scale;
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = a[i * n + k];
      if (i == k || factor == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] -= factor * a[k * n + j];
        inverse[i * n + j] -= factor * inverse[k * n + j];
      }
    }
  }
  return inverse;
}

}  // namespace

std::vector<double> flows(MPI_Comm comm, const std::vector<RankOne>& outlets, std::span<const double> x) {
  std::vector<double> q;
  q.reserve(outlets.size());
  for (const auto& outlet : outlets) {
    double sum = 0;
    for (std::size_t k = 0; k < outlet.nodes.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) sum += outlet.s[k][c] * x[4 * static_cast<std::size_t>(outlet.nodes[k]) + c];
    q.push_back(sum);
  }
  MPI_Allreduce(MPI_IN_PLACE, q.data(), static_cast<int>(q.size()), MPI_DOUBLE, MPI_SUM, comm);
  return q;
}

void add_scaled(const RankOne& outlet, double factor, std::span<double> y) {
  for (std::size_t k = 0; k < outlet.nodes.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) y[4 * static_cast<std::size_t>(outlet.nodes[k]) + c] += factor * outlet.s[k][c];
}

RankOneInverse::RankOneInverse(MPI_Comm comm, std::vector<RankOne> outlets, std::size_t size,
                               const std::function<void(std::span<double>)>& solve)
    : comm_(comm), outlets_(std::move(outlets)) {
  const std::size_t n = outlets_.size();
  std::vector<double> capacitance(n * n);
  for (std::size_t k = 0; k < n; ++k) {
    auto& y = solved_.emplace_back(size, 0.0);
    add_scaled(outlets_[k], 1.0, y);
    solve(y);
    const auto column = flows(comm_, outlets_, y);
    for (std::size_t i = 0; i < n; ++i)
      capacitance[i * n + k] = (i == k ? 1.0 : 0.0) + outlets_[i].coefficient * column[i];
  }
  inverse_ = dense_inverse(std::move(capacitance), n);
}

void RankOneInverse::correct(std::span<double> z) const {
  const std::size_t n = outlets_.size();
  if (n == 0) return;
  auto q = flows(comm_, outlets_, z);
  for (std::size_t k = 0; k < n; ++k) q[k] *= outlets_[k].coefficient;
  for (std::size_t k = 0; k < n; ++k) {
    double factor = 0;
    for (std::size_t j = 0; j < n; ++j) factor += inverse_[k * n + j] * q[j];
    for (std::size_t i = 0; i < z.size(); ++i) z[i] -= factor * solved_[k][i];
  }
}

}  // namespace tunica::assembly
