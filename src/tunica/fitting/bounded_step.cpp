#include "tunica/fitting/bounded_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace tunica::fitting {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::size_t place(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Of the open unknowns, when the others have gone as far as `d`.
Eigen::VectorXd open_step(const Eigen::Map<const Rows>& N, const Eigen::VectorXd& rest,
                          const std::vector<Eigen::Index>& open) {
  const auto m = static_cast<Eigen::Index>(open.size());
  Eigen::MatrixXd A(m, m);
  Eigen::VectorXd b(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    b(i) = -rest(open[place(i)]);
    for (Eigen::Index j = 0; j < m; ++j) A(i, j) = N(open[place(i)], open[place(j)]);
  }
  A.diagonal().array() += 1e-10 * A.diagonal().maxCoeff() + 1e-300;
  return A.ldlt().solve(b);
}

}  // namespace

std::vector<double> bounded_step(std::span<const double> normal, std::span<const double> gradient,
                                 std::span<const double> x, const Box& bounds, std::vector<bool> held) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::Map<const Rows> N(normal.data(), n, n);
  const Eigen::Map<const Eigen::VectorXd> g(gradient.data(), n);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
  for (Eigen::Index round = 0; round <= n; ++round) {
    std::vector<Eigen::Index> open;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!held[place(i)]) open.push_back(i);
    if (open.empty()) break;
    const Eigen::VectorXd more = open_step(N, g + N * d, open);
    double length = 1.0;
    Eigen::Index hit = -1;
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(open.size()); ++i) {
      const Eigen::Index k = open[place(i)];
      const double from = x[place(k)] + d(k), to = from + more(i);
      const double low = bounds.low[place(k)], high = bounds.high[place(k)];
      if (to >= low && to <= high) continue;
      const double share = ((to > high ? high : low) - from) / more(i);
      if (share < length) length = share, hit = k;
    }
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(open.size()); ++i) d(open[place(i)]) += length * more(i);
    if (hit < 0) break;
    held[place(hit)] = true;
  }
  return {d.begin(), d.end()};
}

}  // namespace tunica::fitting
