// Quantities of a cycle against closed forms.
#include "tunica/analysis/cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace tunica::analysis {
namespace {

using std::numbers::pi;

/// A window of uneven steps.
std::vector<double> uneven(int n, double until) {
  std::vector<double> t;
  for (int k = 0; k <= n; ++k) t.push_back(until * (k + 0.3 * std::sin(2 * pi * k / n)) / n);
  return t;
}

TEST(Cycle, WeightsAddUpToTheWindowAndIntegrateStraightLines) {
  const auto t = uneven(17, 0.8);
  const auto w = trapezoid_weights(t);
  EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 0.8, 1e-14);
  double integral = 0;
  for (std::size_t k = 0; k < t.size(); ++k) integral += w[k] * (3 - 2 * t[k]);
  EXPECT_NEAR(integral, 3 * 0.8 - 0.64, 1e-14);
}

TEST(Cycle, RatesOfAParabolaAreExactAtEveryInstant) {
  const auto t = uneven(9, 1.0);
  for (std::size_t k = 0; k < t.size(); ++k) {
    const auto d = derivative_at(t, k);
    double rate = 0;
    for (std::size_t i = 0; i < 3; ++i)
      rate += d.weights[i] * (1 - 4 * t[d.first + i] + 7 * std::pow(t[d.first + i], 2));
    EXPECT_NEAR(rate, -4 + 14 * t[k], 1e-10) << k;
  }
}

TEST(Cycle, CourseOfASine) {
  const auto t = uneven(400, 1.0);
  std::vector<double> v;
  for (const double x : t) v.push_back(0.5 + std::sin(2 * pi * x));
  const auto c = course(t, v);
  EXPECT_NEAR(c.mean, 0.5, 1e-4);
  EXPECT_NEAR(c.largest, 1.5, 1e-4);
  EXPECT_NEAR(c.time_of_smallest, 0.75, 1e-2);
  // 1/2 + sin is negative from 7/12 to 11/12.
  const double backward = std::cos(2 * pi / 12) / pi - 1.0 / 6;
  EXPECT_NEAR(c.backward, backward, 1e-4);
  EXPECT_NEAR(c.forward - c.backward, 0.5, 1e-4);
}

TEST(Cycle, ShearThatOscillatesIsSteadyOrTurns) {
  const auto t = uneven(200, 2.0);
  const auto w = trapezoid_weights(t);
  const auto figures = [&](const auto& tau) {
    double magnitude = 0;
    Vec3<double> sum{{0, 0, 0}};
    for (std::size_t k = 0; k < t.size(); ++k) {
      magnitude += w[k] * norm(tau(t[k]));
      sum = sum + w[k] * tau(t[k]);
    }
    return shear_figures(magnitude, sum, 2.0);
  };
  const auto steady = figures([](double) { return Vec3<double>{{0.3, 0, -0.4}}; });
  EXPECT_NEAR(steady.tawss, 0.5, 1e-14);
  EXPECT_NEAR(steady.osi, 0, 1e-14);
  EXPECT_GE(steady.osi, 0);
  EXPECT_NEAR(steady.rrt, 2, 1e-13);
  const auto oscillating = figures([](double x) { return Vec3<double>{{0, std::sin(pi * x), 0}}; });
  EXPECT_NEAR(oscillating.tawss, 2 / pi, 1e-3);
  EXPECT_NEAR(oscillating.osi, 0.5, 1e-3);
  // Half of the time across: resultant (1, 1) of two unit vectors.
  const auto turned = figures([](double x) { return x < 1 ? Vec3<double>{{1, 0, 0}} : Vec3<double>{{0, 1, 0}}; });
  EXPECT_NEAR(turned.osi, 0.5 * (1 - std::sqrt(0.5)), 2e-3);
  EXPECT_NEAR(turned.rrt, 1 / ((1 - 2 * turned.osi) * turned.tawss), 1e-12);
}

TEST(Cycle, NoShearAtAll) {
  const auto none = shear_figures(0, {{0, 0, 0}}, 1);
  EXPECT_EQ(none.tawss, 0);
  EXPECT_EQ(none.osi, 0);
  EXPECT_EQ(none.rrt, std::numeric_limits<double>::infinity());
}

TEST(Cycle, PercentilesGoByWeight) {
  const std::vector<double> percents = {0, 50, 90, 95, 100};
  // 90 % of the volume hold 1, 10 % hold 5: an unweighted median would be 5.
  const std::vector<std::pair<double, double>> values = {{5, 0.05}, {1, 0.9}, {5, 0.05}, {std::nan(""), 7.0}};
  EXPECT_EQ(percentiles(values, percents), (std::vector<double>{1, 1, 1, 5, 5}));
  EXPECT_TRUE(std::isnan(percentiles({}, percents)[0]));
}

}  // namespace
}  // namespace tunica::analysis
