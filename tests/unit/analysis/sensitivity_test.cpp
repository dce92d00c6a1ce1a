#include "tunica/analysis/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tunica/analysis/sampling.hpp"

namespace tunica::analysis {
namespace {

TEST(Sensitivity, RankCorrelationSeesOrderAlone) {
  const std::vector<double> x = {1, 2, 3, 4, 5};
  EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{1, 8, 27, 64, 125}), 1);
  EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{9, 7, 1, 0, -4}), -1);
  EXPECT_TRUE(std::isnan(rank_correlation(x, std::vector<double>{3, 3, 3, 3, 3})));
  EXPECT_THROW(rank_correlation(x, std::vector<double>{1}), std::invalid_argument);
}

// 1 - 6 sum d^2 / (n (n^2 - 1)) without ties: d = 1, 1, 1, 1, 0. With ties: Pearson's of the mean ranks
// 1, 2.5, 2.5, 4 and 1, 2, 3, 4, which is 4.5 / sqrt(4.5 * 5).
TEST(Sensitivity, RankCorrelationByHand) {
  EXPECT_NEAR(rank_correlation(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{2, 1, 4, 3, 5}), 0.8, 1e-14);
  EXPECT_NEAR(rank_correlation(std::vector<double>{1, 2, 2, 3}, std::vector<double>{1, 2, 3, 4}), 4.5 / std::sqrt(22.5),
              1e-14);
}

TEST(Sensitivity, RankCorrelationLeavesOutWhatFailed) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(rank_correlation(std::vector<double>{1, 2, 3, 4}, std::vector<double>{1, none, 3, 4}), 1);
  EXPECT_TRUE(std::isnan(rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{1, none, 3})));
}

TEST(Sensitivity, RankCorrelationHasAnInterval) {
  // y follows x with noise; Fisher's transform gives about 0.6 to 0.87 at a correlation of 0.77.
  std::vector<double> x, y, along, slow;
  for (int k = 0; k < 60; ++k) {
    x.push_back(std::fmod(0.618034 * k, 1));
    y.push_back(x.back() + 0.8 * std::fmod(0.754878 * k, 1));
    along.push_back(k);
    slow.push_back(std::sin(0.2 * k));
  }
  const auto found = rank_correlation_interval(x, y, 1);
  EXPECT_DOUBLE_EQ(found.value, rank_correlation(x, y));
  EXPECT_EQ(found.pairs, 60U);
  const double z = std::atanh(found.value), half = 1.96 * std::sqrt(1.06 / 57);
  EXPECT_NEAR(found.low, std::tanh(z - half), 0.07);
  EXPECT_NEAR(found.high, std::tanh(z + half), 0.07);
  // Neighbours that move together say less than as many independent pairs.
  const auto alone = rank_correlation_interval(along, slow, 1), blocks = rank_correlation_interval(along, slow, 12);
  EXPECT_GT(blocks.high - blocks.low, 1.2 * (alone.high - alone.low));
  EXPECT_TRUE(std::isnan(rank_correlation_interval(std::vector<double>{1, 2}, std::vector<double>{1, 2}, 1).low));
  EXPECT_THROW(rank_correlation_interval(x, y, 0), std::invalid_argument);
}

/// Ishigami & Homma 1990 on the cube (-pi, pi)^3 with a = 7, b = 0.1.
double ishigami(const std::vector<double>& unit) {
  const auto at = [&](std::size_t d) { return std::numbers::pi * (2 * unit[d] - 1); };
  const double s1 = std::sin(at(0)), s2 = std::sin(at(1));
  return s1 + 7 * s2 * s2 + 0.1 * std::pow(at(2), 4) * s1;
}

std::vector<double> ishigami_values(std::size_t rows, std::uint64_t seed) {
  std::vector<double> values;
  for (const auto& point : saltelli_points(rows, 3, seed)) values.push_back(ishigami(point));
  return values;
}

struct Exact {
  double first[3], total[3];
};

/// From the variances in closed form.
Exact exact_ishigami() {
  const double a = 7, b = 0.1, pi4 = std::pow(std::numbers::pi, 4);
  const double v1 = 0.5 * std::pow(1 + b * pi4 / 5, 2), v2 = a * a / 8, v13 = b * b * pi4 * pi4 * 8 / 225;
  const double v = v1 + v2 + v13;
  return {{v1 / v, v2 / v, 0}, {(v1 + v13) / v, v2 / v, v13 / v}};
}

TEST(Sensitivity, SobolIndicesOfIshigami) {
  const Exact exact = exact_ishigami();
  const std::size_t rows = 4096;
  const auto found = sobol_indices(ishigami_values(rows, 1), rows, 3, 200);
  EXPECT_EQ(found.rows, rows);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(found.of[d].first, exact.first[d], 0.01) << d;
    EXPECT_NEAR(found.of[d].total, exact.total[d], 0.01) << d;
    EXPECT_LT(found.of[d].first_error, 0.05) << d;
  }
}

// With few points, as studies have them: over many shifts nearly all indices lie within three of their errors.
TEST(Sensitivity, SobolIndicesLieWithinTheirErrors) {
  const Exact exact = exact_ishigami();
  const std::size_t rows = 64;
  int within = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto found = sobol_indices(ishigami_values(rows, seed), rows, 3, 200);
    for (std::size_t d = 0; d < 3; ++d) {
      within += std::abs(found.of[d].first - exact.first[d]) <= 3 * found.of[d].first_error;
      within += std::abs(found.of[d].total - exact.total[d]) <= 3 * found.of[d].total_error;
      all += 2;
    }
  }
  EXPECT_GE(within, 95 * all / 100) << within << " of " << all;
}

TEST(Sensitivity, SobolIndicesLeaveOutRowsWithAFailedPoint) {
  const std::size_t rows = 256;
  auto values = ishigami_values(rows, 1);
  values[3] = values[4 * rows + 7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sobol_indices(values, rows, 3, 10).rows, rows - 2);
  EXPECT_THROW(sobol_indices(values, rows, 4, 10), std::invalid_argument);
  EXPECT_TRUE(std::isnan(sobol_indices(std::vector<double>(rows * 5, 2.0), rows, 3, 10).of[0].first));
}

}  // namespace
}  // namespace tunica::analysis
