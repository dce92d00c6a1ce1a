#include "tunica/fitting/correlation.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace tunica::fitting {

namespace {

/// Rows of one measured quantity of one protocol, by their places among the residuals.
struct Run {
  std::size_t first, stride, count;
  Eigen::Index at(std::size_t i) const { return static_cast<Eigen::Index>(first + i * stride); }
};

std::vector<Run> runs_of(const Model& model) {
  std::vector<Run> runs;
  std::size_t offset = 0;
  for (const Protocol& p : model.protocols()) {
    for (std::size_t c = 0; c < p.components(); ++c) runs.push_back({offset + c, p.components(), p.rows.size()});
    offset += p.values();
  }
  return runs;
}

/// Mean products of a row with itself and with the next.
struct Products {
  double own = 0.0, neighbour = 0.0;
  double correlation() const { return own > 0.0 ? neighbour / own : 0.0; }
};

template <class ProductOf>
Products mean_products(const std::vector<Run>& runs, const ProductOf& product) {
  Products sum;
  double rows = 0.0, pairs = 0.0;
  for (const Run& run : runs)
    for (std::size_t i = 0; i < run.count; ++i) {
      sum.own += product(run.at(i), run.at(i), 0);
      rows += 1.0;
      if (i + 1 == run.count) continue;
      sum.neighbour += product(run.at(i), run.at(i + 1), 1);
      pairs += 1.0;
    }
  return {sum.own / std::max(rows, 1.0), sum.neighbour / std::max(pairs, 1.0)};
}

using Columns = Eigen::MatrixXd;

/// An orthonormal basis of what the free unknowns can follow.
Columns followed(const Linearised& fitted) {
  const std::size_t n = fitted.held.size(), m = fitted.residuals.size();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < n; ++i)
    if (!fitted.held[i]) open.push_back(i);
  Columns J(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(open.size()));
  for (std::size_t i = 0; i < open.size(); ++i)
    for (std::size_t k = 0; k < m; ++k)
      J(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = fitted.slopes[k * n + open[i]];
  for (Eigen::Index i = 0; i < J.cols(); ++i)
    if (const double size = J.col(i).norm(); size > 0.0) J.col(i) /= size;
  const Eigen::ColPivHouseholderQR<Columns> qr(J);
  return Columns(qr.householderQ() * Columns::Identity(J.rows(), qr.rank()));
}

/// Products of the residuals that are expected of noise of unit variance: (1 - Q Q^T) S (1 - Q Q^T), S_ij =
/// share^|i-j|.
Products expected(const std::vector<Run>& runs, const Columns& Q, double share) {
  Columns W = Columns::Zero(Q.rows(), Q.cols());  // S Q, by one sweep forwards and one back
  for (const Run& run : runs) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(Q.cols());
    for (std::size_t i = 0; i < run.count; ++i) {
      sum = share * sum + Q.row(run.at(i));
      W.row(run.at(i)) += sum;
    }
    sum.setZero();
    for (std::size_t i = run.count; i-- > 0;) {
      W.row(run.at(i)) += share * sum;
      sum = share * sum + Q.row(run.at(i));
    }
  }
  const Columns G = Q.transpose() * W;
  return mean_products(runs, [&](Eigen::Index i, Eigen::Index j, int lag) {
    return (lag == 0 ? 1.0 : share) - Q.row(i).dot(W.row(j)) - W.row(i).dot(Q.row(j)) + (Q.row(i) * G).dot(Q.row(j));
  });
}

/// The share that gives neighbours this correlation after the fit, which grows with it.
double share_for(const std::vector<Run>& runs, const Columns& Q, double correlation, double most) {
  double low = 0.0, high = most;
  for (int halving = 0; halving < 24; ++halving) {
    const double middle = 0.5 * (low + high);
    (expected(runs, Q, middle).correlation() < correlation ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// 1 + twice the sum of the autocorrelations up to the first that is not positive.
double sampled_length(const std::vector<Run>& runs, const std::vector<double>& residuals, std::size_t longest) {
  double length = 1.0, variance = 0.0;
  for (std::size_t lag = 0; lag < std::max<std::size_t>(longest / 2, 1); ++lag) {
    double sum = 0.0, pairs = 0.0;
    for (const Run& run : runs)
      for (std::size_t i = 0; i + lag < run.count; ++i) {
        sum += residuals[static_cast<std::size_t>(run.at(i))] * residuals[static_cast<std::size_t>(run.at(i + lag))];
        pairs += 1.0;
      }
    if (!(pairs > 0.0) || !(sum > 0.0)) break;
    if (lag == 0)
      variance = sum / pairs;
    else
      length += 2.0 * sum / pairs / variance;
  }
  return length;
}

}  // namespace

double Correlation::length_in_blocks(double rows) const {
  double sum = 1.0, power = share;
  for (double lag = 1.0; lag < rows; lag += 1.0, power *= share) sum += 2.0 * (1.0 - lag / rows) * power;
  return sum;
}

Correlation correlation_of(const Model& model, const Linearised& fitted) {
  const std::vector<Run> runs = runs_of(model);
  std::size_t longest = 1;
  for (const Run& run : runs) longest = std::max(longest, run.count);
  const auto& r = fitted.residuals;
  const Products found = mean_products(runs, [&](Eigen::Index i, Eigen::Index j, int) {
    return r[static_cast<std::size_t>(i)] * r[static_cast<std::size_t>(j)];
  });
  if (!(found.own > 0.0)) return {};
  const auto share_of_length = [](double length) { return (length - 1.0) / (length + 1.0); };
  const double most = share_of_length(static_cast<double>(longest));
  const Columns Q = followed(fitted);
  Correlation c;
  c.share = std::min(
      most, std::max(share_for(runs, Q, found.correlation(), most), share_of_length(sampled_length(runs, r, longest))));
  c.length = (1.0 + c.share) / (1.0 - c.share);
  c.lost_variance = std::clamp(expected(runs, Q, c.share).own, 0.1, 1.0);
  return c;
}

double student_95(double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(std::max(degrees_of_freedom, 1.0)), 0.975);
}

}  // namespace tunica::fitting
