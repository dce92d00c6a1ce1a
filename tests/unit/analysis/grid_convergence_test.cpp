#include "tunica/analysis/grid_convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace tunica::analysis {
namespace {

using Kind = ErrorBand::Kind;

std::vector<double> values_of(const std::vector<double>& sizes, double order) {
  std::vector<double> values;
  for (const double h : sizes) values.push_back(7.0 + 0.3 * std::pow(h, order));
  return values;
}

TEST(GridConvergence, FindsTheOrderAndTheLimitOfAPower) {
  const std::vector<double> sizes = {1.0, 0.7, 0.45};  // no constant ratio
  for (const double order : {0.8, 1.7, 2.0}) {
    const auto e = error_band(sizes, values_of(sizes, order), 2.0);
    EXPECT_EQ(e.kind, Kind::monotone);
    EXPECT_NEAR(e.order, order, 1e-9);
    EXPECT_NEAR(e.extrapolated, 7.0, 1e-9);
    EXPECT_NEAR(e.band, 1.25 * 0.3, 1e-9);
  }
}

TEST(GridConvergence, TheBandIsThatOfTheFirstOfManyLevels) {
  const std::vector<double> sizes = {2.0, 1.0, 0.5, 0.25};
  EXPECT_NEAR(error_band(sizes, values_of(sizes, 1.0), 2.0).band, 1.25 * 0.6, 1e-9);
}

// What converges faster than it can is not believed: the order is cut, and the factor is 3.
TEST(GridConvergence, AnOrderThatIsTooHighIsCut) {
  const std::vector<double> sizes = {1.0, 0.5, 0.25};
  const auto e = error_band(sizes, values_of(sizes, 5.0), 2.0);
  EXPECT_NEAR(e.order, 5.0, 1e-9);
  EXPECT_GT(e.band, 3 * 0.3 * 0.99);
}

TEST(GridConvergence, TwoLevelsTakeTheFormalOrder) {
  const auto e = error_band(std::vector{1.0, 0.5}, std::vector{1.4, 1.1}, 2.0);
  EXPECT_EQ(e.kind, Kind::two_levels);
  EXPECT_NEAR(e.extrapolated, 1.0, 1e-12);
  EXPECT_NEAR(e.band, 1.2, 1e-12);
}

TEST(GridConvergence, NamesWhatDoesNotConverge) {
  const std::vector<double> sizes = {1.0, 0.5, 0.25};
  const auto oscillating = error_band(sizes, std::vector{1.0, 1.3, 1.1}, 2.0);
  EXPECT_EQ(oscillating.kind, Kind::oscillating);
  EXPECT_NEAR(oscillating.band, 0.9, 1e-12);
  const auto diverging = error_band(sizes, std::vector{1.0, 1.1, 1.3}, 2.0);
  EXPECT_EQ(diverging.kind, Kind::diverging);
  EXPECT_NEAR(diverging.band, 0.9, 1e-12);
  EXPECT_TRUE(std::isnan(diverging.order));
  EXPECT_EQ(error_band(sizes, std::vector{1.0, 1.2, 1.2}, 2.0).kind, Kind::monotone);
  EXPECT_EQ(error_band(sizes, std::vector{1.2, 1.2, 1.0}, 2.0).kind, Kind::diverging);
  EXPECT_EQ(error_band(sizes, std::vector{1.2, 1.2, 1.2}, 2.0).band, 0.0);
}

TEST(GridConvergence, RefusesWhatIsNoSeries) {
  EXPECT_THROW(error_band(std::vector{1.0, 1.0}, std::vector{1.0, 2.0}, 2.0), std::invalid_argument);
  EXPECT_THROW(error_band(std::vector{1.0, 0.5}, std::vector{1.0}, 2.0), std::invalid_argument);
  EXPECT_TRUE(std::isnan(error_band(std::vector{1.0}, std::vector{1.0}, 2.0).band));
}

}  // namespace
}  // namespace tunica::analysis
