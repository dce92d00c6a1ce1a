#include "tunica/analysis/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "tunica/base/limits.hpp"

namespace tunica::analysis {

namespace {

using base::nan;

/// From 1; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k) rank[order[k]] = 0.5 * static_cast<double>(begin + 1 + end);
    begin = end;
  }
  return rank;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean(x), my = mean(y);
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    yy += (y[k] - my) * (y[k] - my);
    xy += (x[k] - mx) * (y[k] - my);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : nan;
}

std::pair<std::vector<double>, std::vector<double>> finite_pairs(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw std::invalid_argument("rank_correlation: numbers of values differ");
  std::pair<std::vector<double>, std::vector<double>> given;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!std::isfinite(x[k]) || !std::isfinite(y[k])) continue;
    given.first.push_back(x[k]);
    given.second.push_back(y[k]);
  }
  return given;
}

double rank_correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
  return x.size() < 3 ? nan : correlation(ranks(x), ranks(y));
}

/// f at A, B and the AB_i, by row.
struct Blocks {
  std::vector<double> a, b;
  std::vector<std::vector<double>> ab;
};

Blocks whole_rows(std::span<const double> values, std::size_t rows, std::size_t dimensions) {
  Blocks blocks;
  blocks.ab.resize(dimensions);
  for (std::size_t k = 0; k < rows; ++k) {
    bool whole = true;
    for (std::size_t block = 0; block < dimensions + 2; ++block)
      whole = whole && std::isfinite(values[block * rows + k]);
    if (!whole) continue;
    blocks.a.push_back(values[k]);
    blocks.b.push_back(values[rows + k]);
    for (std::size_t d = 0; d < dimensions; ++d) blocks.ab[d].push_back(values[(d + 2) * rows + k]);
  }
  return blocks;
}

/// First-order and total index of parameter `d` from the rows in `sample`.
std::pair<double, double> indices(const Blocks& f, std::size_t d, const std::vector<std::size_t>& sample) {
  const double n = static_cast<double>(sample.size());
  double sum = 0, squares = 0, first = 0, total = 0;
  for (const auto k : sample) sum += f.a[k] + f.b[k];
  const double centre = sum / (2 * n);
  for (const auto k : sample) {
    const double a = f.a[k] - centre, b = f.b[k] - centre, ab = f.ab[d][k] - centre;
    squares += a * a + b * b;
    first += b * (ab - a);
    total += (a - ab) * (a - ab);
  }
  const double variance = squares / (2 * n);
  if (!(variance > 0)) return {nan, nan};
  return {first / n / variance, total / (2 * n) / variance};
}

double deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double squares = 0;
  for (const double v : values) squares += (v - m) * (v - m);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

}  // namespace

double rank_correlation(std::span<const double> x, std::span<const double> y) {
  const auto [given_x, given_y] = finite_pairs(x, y);
  return rank_correlation_of(given_x, given_y);
}

RankCorrelation rank_correlation_interval(std::span<const double> x, std::span<const double> y, std::size_t block,
                                          std::size_t bootstraps, std::uint64_t seed) {
  if (block == 0) throw std::invalid_argument("rank_correlation_interval: a block of none");
  const auto [given_x, given_y] = finite_pairs(x, y);
  const std::size_t n = given_x.size();
  RankCorrelation result{rank_correlation_of(given_x, given_y), nan, nan, n};
  if (!std::isfinite(result.value)) return result;
  std::mt19937_64 random(seed);
  std::vector<double> values, sample_x(n), sample_y(n);
  for (std::size_t k = 0; k < bootstraps; ++k) {
    for (std::size_t filled = 0; filled < n;) {
      const std::size_t first = random() % n;
      for (std::size_t i = 0; i < block && filled < n; ++i, ++filled) {
        sample_x[filled] = given_x[(first + i) % n];
        sample_y[filled] = given_y[(first + i) % n];
      }
    }
    if (const double value = rank_correlation_of(sample_x, sample_y); std::isfinite(value)) values.push_back(value);
  }
  if (values.size() < 2) return result;
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  result.low = at(0.025);
  result.high = at(0.975);
  return result;
}

SobolIndices sobol_indices(std::span<const double> values, std::size_t rows, std::size_t dimensions,
                           std::size_t bootstraps, std::uint64_t seed) {
  if (values.size() != rows * (dimensions + 2))
    throw std::invalid_argument("sobol_indices: there are not rows * (dimensions + 2) values");
  const Blocks blocks = whole_rows(values, rows, dimensions);
  SobolIndices result{.of = std::vector<SobolIndex>(dimensions, {nan, nan, nan, nan}), .rows = blocks.a.size()};
  if (result.rows < 2) return result;
  std::vector<std::size_t> all(result.rows), sample(result.rows);
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::mt19937_64 random(seed);
    std::vector<double> first, total;
    for (std::size_t k = 0; k < bootstraps; ++k) {
      for (auto& row : sample) row = random() % result.rows;
      const auto [one, all_of_it] = indices(blocks, d, sample);
      if (!std::isfinite(one)) continue;  // all rows of the sample are alike
      first.push_back(one);
      total.push_back(all_of_it);
    }
    const auto [one, all_of_it] = indices(blocks, d, all);
    result.of[d] = {.first = one,
                    .total = all_of_it,
                    .first_error = first.size() > 1 ? deviation(first) : nan,
                    .total_error = total.size() > 1 ? deviation(total) : nan};
  }
  return result;
}

}  // namespace tunica::analysis
