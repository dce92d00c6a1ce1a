#include "tunica/fitting/uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <random>
#include <thread>
#include <tuple>

#include "tunica/base/error.hpp"

namespace tunica::fitting {

namespace {

constexpr double normal_95 = 1.959964;
constexpr double small_part = 0.5;  ///< of the scaled range: an interval beyond it says little

/// A fall of the sum of squares that changes the likelihood by nothing that matters.
double little(const Fit& fit) { return 2e-2 * fit.squares / fit.degrees_of_freedom(); }

/// Does work for 0 ... count - 1 on several threads, each with a worker of its own.
template <class MakeWorker>
void in_parallel(std::size_t count, int threads, const MakeWorker& make_worker) {
  std::size_t next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto take = [&](std::size_t& i) {
    const std::lock_guard<std::mutex> lock(mutex);
    i = next++;
    return i < count && !failure;
  };
  const auto loop = [&] {
    try {
      auto work = make_worker();
      for (std::size_t i = 0; take(i);) work(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(loop);
  loop();
  for (auto& t : others) t.join();
  if (failure) std::rethrow_exception(failure);
}

/// Noise of one replicate in Pa: blocks of rows of the fit's own residuals, put together anew, so that neighbours stay
/// neighbours. Both stresses of a row move together. A block comes from any protocol of the same test and with either
/// sign: at their own places residuals are what the unknowns could not follow, and the replicates would not move.
class Blocks {
 public:
  Blocks(const Model& model, const Fit& fit, std::size_t length, double factor) : model_(model), length_(length) {
    const auto measured = model.measured();
    for (std::size_t k = 0; k < measured.size(); ++k) {
      std::vector<double>& r = residuals_.emplace_back(measured[k]);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] = factor * (r[i] - fit.predicted[k][i]);
      std::vector<std::size_t>& alike = alike_.emplace_back();
      const Protocol& p = model.protocols()[k];
      for (std::size_t j = 0; j < measured.size(); ++j) {
        const Protocol& q = model.protocols()[j];
        if (p.specimen == q.specimen && p.test == q.test) alike.push_back(j);
      }
    }
  }

  std::vector<std::vector<double>> draw(std::mt19937_64& random) const {
    std::vector<std::vector<double>> drawn;
    for (std::size_t k = 0; k < residuals_.size(); ++k) {
      const std::size_t wanted = residuals_[k].size();
      std::vector<double>& r = drawn.emplace_back();
      while (r.size() < wanted) append_block(alike_[k], wanted, random, r);
    }
    return drawn;
  }

 private:
  void append_block(const std::vector<std::size_t>& alike, std::size_t wanted, std::mt19937_64& random,
                    std::vector<double>& r) const {
    const std::size_t from = alike[std::uniform_int_distribution<std::size_t>(0, alike.size() - 1)(random)];
    const Protocol& p = model_.protocols()[from];
    const std::size_t rows = p.rows.size(), c = p.components();
    const std::size_t start = std::uniform_int_distribution<std::size_t>(0, rows - 1)(random);
    const double sign = std::bernoulli_distribution(0.5)(random) ? 1.0 : -1.0;
    for (std::size_t i = 0; i < std::min(length_, rows) && r.size() < wanted; ++i)
      for (std::size_t j = 0; j < c; ++j) r.push_back(sign * residuals_[from][((start + i) % rows) * c + j]);
  }

  const Model& model_;
  std::size_t length_;
  std::vector<std::vector<double>> residuals_;
  std::vector<std::vector<std::size_t>> alike_;  ///< by protocol, those of the same test
};

/// A place from which a replicate is fitted.
struct Start {
  std::vector<double> x, slopes;
};

/// The fit, and along the profiles of what is not identified, places that fit as well: a search from the fit alone
/// would stay beside it, and with it all parameters that depend on the one that is not identified.
std::vector<Start> starts_of(const Model& model, const Fit& fit, const std::vector<Determination>& unknowns) {
  std::vector<Start> starts{{fit.x, fit.at_end.slopes}};
  const Residuals residuals = model.against(model.measured());
  const double limit = std::pow(student_95(fit.degrees_of_freedom()), 2);
  for (const Determination& d : unknowns) {
    if (d.identification == Identification::identified) continue;
    for (const ProfilePoint& point : d.points) try {
        if (fit.excess(point.squares) < limit) starts.push_back({point.x, jacobian(residuals, point.x)});
      } catch (const SolverError&) {  // the law has no stress beside it
      }
  }
  return starts;
}

std::vector<std::vector<double>> bootstrap(const Model& model, const Fit& fit, std::size_t block,
                                           const std::vector<Start>& starts, const UncertaintyOptions& options) {
  // The fit has taken some of the noise, and cuts between blocks take some of its likeness. The variance of what is
  // left is uncertain, too, which is Student's.
  const double cut = fit.correlation.length / fit.correlation.length_in_blocks(static_cast<double>(block));
  const double factor =
      std::sqrt(cut / fit.correlation.lost_variance) * student_95(fit.degrees_of_freedom()) / normal_95;
  const Blocks blocks(model, fit, block, factor);
  std::vector<std::vector<double>> found(static_cast<std::size_t>(options.replicates));
  in_parallel(found.size(), options.threads, [&] {
    return [&, own = model](std::size_t i) {
      std::mt19937_64 random(options.seed * 1000003 + i);
      std::vector<std::vector<double>> targets = blocks.draw(random);
      for (std::size_t k = 0; k < targets.size(); ++k)
        for (std::size_t n = 0; n < targets[k].size(); ++n) targets[k][n] += fit.predicted[k][n];
      const Residuals residuals = own.against(std::move(targets));
      double least = std::numeric_limits<double>::infinity();
      const auto search = [&](Start start) {
        try {
          const Minimum end = refit(residuals, std::move(start.x), start.slopes, little(fit));
          if (end.squares >= least) return;
          least = end.squares;
          found[i] = end.x;
        } catch (const SolverError&) {  // left out
        }
      };
      search(starts.front());
      if (starts.size() > 1) search(starts[1 + i % (starts.size() - 1)]);
    };
  });
  std::erase_if(found, [](const auto& x) { return x.empty(); });
  return found;
}

std::vector<std::vector<double>> correlations(const std::vector<std::vector<double>>& replicates, std::size_t n) {
  std::vector<double> mean(n, 0.0);
  const double count = static_cast<double>(replicates.size());
  for (const auto& r : replicates)
    for (std::size_t i = 0; i < n; ++i) mean[i] += r[i] / count;
  std::vector<std::vector<double>> C(n, std::vector<double>(n, 0.0));
  for (const auto& r : replicates)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) C[i][j] += (r[i] - mean[i]) * (r[j] - mean[j]);
  std::vector<double> spread(n);
  for (std::size_t i = 0; i < n; ++i) spread[i] = std::sqrt(C[i][i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      C[i][j] = i == j ? 1.0 : (spread[i] > 0.0 && spread[j] > 0.0 ? C[i][j] / (spread[i] * spread[j]) : 0.0);
  return C;
}

/// Half width of the interval that the curvature at the minimum tells, for the first step of a profile.
std::vector<double> expected_widths(const Fit& fit) {
  const auto n = static_cast<Eigen::Index>(fit.x.size()), m = static_cast<Eigen::Index>(fit.at_end.residuals.size());
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
      fit.at_end.slopes.data(), m, n);
  Eigen::MatrixXd normal = rows.transpose() * rows;
  normal.diagonal().array() += 1e-12 * normal.diagonal().maxCoeff() + 1e-300;
  const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  const double variance = fit.squares / fit.degrees_of_freedom();
  std::vector<double> widths;
  for (Eigen::Index i = 0; i < n; ++i)
    widths.push_back(student_95(fit.degrees_of_freedom()) * std::sqrt(variance * std::max(inverse(i, i), 0.0)));
  return widths;
}

/// One side of the profile of an unknown: from the minimum in growing steps until the fit has become worse than noise
/// explains or the bound is reached.
class Side {
 public:
  Side(const Residuals& residuals, const Fit& fit, std::size_t unknown)
      : residuals_(residuals), fit_(fit), unknown_(unknown) {}

  /// Returns where the interval ends, and whether that is open.
  std::pair<double, bool> walk(double direction, double step, std::vector<ProfilePoint>& points) const {
    const double bound = direction > 0.0 ? 1.0 : 0.0, wanted = student_95(fit_.degrees_of_freedom());
    std::vector<double> x = fit_.x;
    double last = x[unknown_], last_root = 0.0;
    constexpr int most_points = 24;
    for (int k = 0; k < most_points && last != bound; ++k, step *= 1.4) {
      x[unknown_] = direction > 0.0 ? std::min(bound, last + step) : std::max(bound, last - step);
      Minimum there;
      try {
        there = fitted_beside(x);
      } catch (const SolverError&) {  // the law has no stress that far: the interval ends before it
        return {last, false};
      }
      points.push_back({there.x, there.squares});
      const double root = std::sqrt(std::max(fit_.excess(there.squares), 0.0));
      if (root >= wanted) {
        const double share = (wanted - last_root) / std::max(root - last_root, 1e-300);
        return {last + share * (x[unknown_] - last), false};
      }
      last = x[unknown_];
      last_root = root;
      x = there.x;
    }
    return {last, true};
  }

 private:
  Minimum fitted_beside(const std::vector<double>& x) const {
    std::vector<bool> held(fit_.x.size(), false);
    held[unknown_] = true;
    std::vector<double> slopes = jacobian(residuals_, x, held);
    return refit(residuals_, x, slopes, little(fit_), {.held = held, .thorough = true});
  }

  const Residuals& residuals_;
  const Fit& fit_;
  std::size_t unknown_;
};

Determination profile(const Residuals& residuals, const Fit& fit, std::size_t i, double width) {
  Determination d;
  const double step = std::clamp(0.4 * width, 1e-4, 0.1);
  const Side side(residuals, fit, i);
  std::vector<ProfilePoint> below, above;
  std::tie(d.profile.low, d.open_below) = side.walk(-1.0, step, below);
  std::tie(d.profile.high, d.open_above) = side.walk(1.0, step, above);
  d.points.assign(below.rbegin(), below.rend());
  d.points.push_back({fit.x, fit.squares});
  d.points.insert(d.points.end(), above.begin(), above.end());
  if (d.open_below || d.open_above)
    d.identification = Identification::not_identified;
  else if (d.profile.high - d.profile.low > small_part)
    d.identification = Identification::weak;
  return d;
}

/// Rows in a block: longer ones keep more of the likeness, shorter ones are more.
std::size_t block_length(const Model& model, const Fit& fit) {
  std::size_t longest = 1;
  for (const Protocol& p : model.protocols()) longest = std::max(longest, p.rows.size());
  const double wanted = std::ceil(2.0 * fit.correlation.length);
  return std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, longest);
}

}  // namespace

Interval percentiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double position = share * (static_cast<double>(values.size()) - 1.0);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
  };
  return {at(0.025), at(0.975)};
}

Uncertainty uncertainty(const Model& model, const Fit& fit, const UncertaintyOptions& options) {
  const std::size_t n = model.unknowns().size();
  Uncertainty result;
  result.unknowns.resize(n);
  result.block = block_length(model, fit);
  const std::vector<double> widths = expected_widths(fit);
  in_parallel(n, options.threads, [&] {
    return [&, own = model](std::size_t i) {
      result.unknowns[i] = profile(own.against(own.measured()), fit, i, widths[i]);
    };
  });
  result.replicates = bootstrap(model, fit, result.block, starts_of(model, fit, result.unknowns), options);
  if (result.replicates.size() < 20)
    throw SolverError("fewer than 20 replicates of the bootstrap came to a fit: narrow the bounds of the parameters");
  for (std::size_t i = 0; i < n; ++i) {
    Determination& d = result.unknowns[i];
    std::vector<double> values;
    for (const auto& x : result.replicates) values.push_back(x[i]);
    d.bootstrap = percentiles(std::move(values));
    d.interval = {std::min(d.bootstrap.low, d.profile.low), std::max(d.bootstrap.high, d.profile.high)};
  }
  result.correlation = correlations(result.replicates, n);
  return result;
}

}  // namespace tunica::fitting
