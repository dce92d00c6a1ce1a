// A search that asks for few evaluations: valleys, bounds, evaluations that fail, what is not determined.
#include "tunica/fitting/broyden_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace tunica::fitting {
namespace {

using Answer = std::optional<std::vector<double>>;
using Function = std::function<Answer(const std::vector<double>&)>;

struct Counts {
  int all = 0, differences = 0, failed = 0;
};

/// Answers until the search has ended, or has asked `most` times.
Counts answer(BroydenSearch& search, const Function& function, int most = 200) {
  Counts counts;
  while (search.next() && counts.all < most) {
    ++counts.all;
    counts.differences += search.next()->purpose == Purpose::difference;
    const Answer r = function(search.next()->x);
    counts.failed += !r;
    search.tell(r);
  }
  return counts;
}

Answer rosenbrock(const std::vector<double>& x) {
  return std::vector<double>{200 * (x[1] - x[0] * x[0]), 20 * (1 - x[0])};
}

/// Four values that follow three unknowns, none of them in proportion; least at (0.4, -0.3, 0.7).
std::vector<double> values_at(const std::vector<double>& x) {
  return {std::exp(x[0]) + 0.3 * x[1], std::exp(x[1]) - 0.2 * x[2] * x[0], std::exp(-x[2]) + 0.3 * std::exp(x[0]),
          x[0] * x[1] + 0.2 * x[2]};
}

Answer curved(const std::vector<double>& x) {
  const auto values = values_at(x), wanted = values_at({0.4, -0.3, 0.7});
  std::vector<double> r;
  for (std::size_t k = 0; k < values.size(); ++k) r.push_back(20 * (values[k] - wanted[k]));
  return r;
}

const BroydenOptions fine{.tolerance = 1e-4, .difference = 1e-3};

TEST(BroydenSearch, GoesDownTheValley) {
  BroydenSearch search({-1.2, 1}, {{-3, -3}, {3, 3}}, fine);
  answer(search, rosenbrock);
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_NEAR(search.x()[0], 1, 1e-2);
  EXPECT_NEAR(search.x()[1], 1, 2e-2);
}

TEST(BroydenSearch, StepsCostOneEvaluationEach) {
  BroydenSearch search({1.2, 0.6, -0.5}, {{-2, -2, -2}, {2, 2, 2}}, {});
  const auto counts = answer(search, curved);
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_NEAR(search.x()[0], 0.4, 0.02);
  EXPECT_NEAR(search.x()[1], -0.3, 0.02);
  EXPECT_NEAR(search.x()[2], 0.7, 0.03);
  // Differences at each place would be three for every step.
  const int steps = counts.all - counts.differences - 1;
  EXPECT_GE(steps, 4);
  EXPECT_LT(counts.differences, 3 * steps);
  EXPECT_EQ(counts.differences % 3, 0);
  std::printf("  %d evaluations, %d of them differences\n", counts.all, counts.differences);
}

TEST(BroydenSearch, OneUnknownNeedsOneDifference) {
  BroydenSearch search({std::log(0.5)}, {{-3}, {3}}, {});
  const auto counts =
      answer(search, [](const auto& x) { return Answer(std::vector<double>{20 * (std::exp(-x[0]) - 1)}); });
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_NEAR(search.x()[0], 0, 0.005);
  EXPECT_EQ(counts.differences, 1);
  EXPECT_LE(counts.all, 7);
}

TEST(BroydenSearch, StaysWithinBounds) {
  BroydenSearch search({0.2, -1}, {{-3, -1.5}, {0.5, 3}}, fine);  // starts near one, ends on one
  answer(search, [](const auto& x) {
    EXPECT_LE(x[0], 0.5);
    EXPECT_GE(x[1], -1.5);
    return rosenbrock(x);
  });
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_DOUBLE_EQ(search.x()[0], 0.5);
  EXPECT_NEAR(search.x()[1], 0.25, 1e-3);
}

TEST(BroydenSearch, StartsOnABound) {
  BroydenSearch search({3, -3}, {{-3, -3}, {3, 3}}, fine);
  answer(search, rosenbrock);
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_NEAR(search.x()[0], 1, 1e-2);
}

TEST(BroydenSearch, ShortensStepsWhereEvaluationsFail) {
  const auto function = [](const std::vector<double>& x) { return x[0] > 1.6 || x[0] < 0.39 ? Answer{} : curved(x); };
  BroydenSearch search({1.59, 0.6, -0.5}, {{-2, -2, -2}, {2, 2, 2}}, {});
  const auto counts = answer(search, function);
  EXPECT_GT(counts.failed, 1);  // the first difference is one of them
  EXPECT_LT(search.squares(), 1);
  EXPECT_NEAR(search.x()[0], 0.4, 0.02);

  BroydenSearch nowhere({0.5, 0.5}, {{-3, -3}, {3, 3}}, {});
  EXPECT_EQ(answer(nowhere, [](const auto&) { return Answer{}; }).all, 1);
  EXPECT_EQ(nowhere.end(), SearchEnd::start_failed);

  BroydenSearch alone({0.5, 0.5}, {{-3, -3}, {3, 3}}, {});
  answer(alone, [](const auto& x) { return x[1] == 0.5 ? rosenbrock(x) : Answer{}; });
  EXPECT_EQ(alone.end(), SearchEnd::failing);
  EXPECT_TRUE(alone.slopes().empty());
}

TEST(BroydenSearch, LeavesWhatIsHardlyFollowedWhereItIs) {
  BroydenSearch search({0.5, 0.3}, {{-3, -3}, {3, 3}}, {});
  answer(search, [](const auto& x) { return Answer(std::vector<double>{20 * x[0], 10 * x[0], 0.05 * (x[1] - 9)}); });
  EXPECT_EQ(search.end(), SearchEnd::converged);
  EXPECT_NEAR(search.x()[0], 0, 1e-3);
  EXPECT_NEAR(search.x()[1], 0.3, 0.5);
}

TEST(BroydenSearch, AsksTheSameAgain) {
  std::vector<std::vector<double>> first, second;
  for (auto* all : {&first, &second}) {
    BroydenSearch search({1.2, 0.6, -0.5}, {{-2, -2, -2}, {2, 2, 2}}, {});
    answer(search, [&](const auto& x) {
      all->push_back(x);
      return curved(x);
    });
  }
  EXPECT_EQ(first, second);
}

TEST(Estimates, AreThoseOfTheLinearModel) {
  // Slopes (2, 0), (0, 1), (0, 1): variances 1/4 and 1/2.
  const auto e = estimate({2, 0, 0, 1, 0, 1}, {0.1, 0.1, -0.1}, 2, 3);
  EXPECT_DOUBLE_EQ(e.variance, 1);
  EXPECT_NEAR(e.deviations[0], 0.5, 1e-9);
  EXPECT_NEAR(e.deviations[1], std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(e.quantile, 1.96, 1e-3);
  EXPECT_NEAR(e.correlation[0][1], 0, 1e-9);
}

TEST(Estimates, TellWhatIsNotDetermined) {
  // Residuals three times their deviation: the intervals grow with them. The last unknown changes nothing.
  const auto e = estimate({1, 0.99, 0, 1, 1.01, 0, 1, 1, 0, 1, 1, 0}, {3, -3, 3, -3}, 3, 7);
  EXPECT_NEAR(e.variance, 9, 1e-12);
  EXPECT_GT(e.quantile, 2.7);
  EXPECT_LT(e.correlation[0][1], -0.99);
  EXPECT_GT(e.deviations[0], 50);
  EXPECT_TRUE(std::isinf(e.deviations[2]));
}

}  // namespace
}  // namespace tunica::fitting
