#include "tunica/base/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica {
namespace {

using InTwo = Dual<double, 2>;
using DD = Dual<InTwo, 2>;  // first and second derivatives

const double x0 = 1.3, y0 = 0.7;

/// Expects f(x) to have the derivative df and second derivative ddf at x0; f is called with InTwo and DD.
template <class F>
void expect_derivatives(F f, double value, double df, double ddf) {
  const InTwo first = f(InTwo::variable(x0, 0));
  EXPECT_NEAR(first.value, value, 1e-15 * (1 + std::fabs(value)));
  EXPECT_NEAR(first.d[0], df, 1e-14 * (1 + std::fabs(df)));
  EXPECT_EQ(first.d[1], 0.0);
  const DD second = f(DD::variable(InTwo::variable(x0, 0), 0));
  EXPECT_NEAR(second.value.value, value, 1e-15 * (1 + std::fabs(value)));
  EXPECT_NEAR(second.value.d[0], df, 1e-14 * (1 + std::fabs(df)));
  EXPECT_NEAR(second.d[0].value, df, 1e-14 * (1 + std::fabs(df)));
  EXPECT_NEAR(second.d[0].d[0], ddf, 1e-13 * (1 + std::fabs(ddf)));
}

TEST(DualFunctions, FirstAndSecondDerivatives) {
  const double e = std::exp(x0), s = std::sqrt(x0);
  expect_derivatives([](auto x) { return exp(x); }, e, e, e);
  expect_derivatives([](auto x) { return log(x); }, std::log(x0), 1 / x0, -1 / (x0 * x0));
  expect_derivatives([](auto x) { return sqrt(x); }, s, 0.5 / s, -0.25 / (x0 * s));
  expect_derivatives([](auto x) { return pow(x, 2.7); }, std::pow(x0, 2.7), 2.7 * std::pow(x0, 1.7),
                     2.7 * 1.7 * std::pow(x0, 0.7));
  expect_derivatives([](auto x) { return abs(-(x * x)); }, x0 * x0, 2 * x0, 2.0);
  expect_derivatives([](auto x) { return 1.0 / x; }, 1 / x0, -1 / (x0 * x0), 2 / (x0 * x0 * x0));
  expect_derivatives([](auto x) { return x * x * x - 2.0 * x + 1.0; }, x0 * x0 * x0 - 2 * x0 + 1, 3 * x0 * x0 - 2,
                     6 * x0);
  expect_derivatives(
      [](auto x) { return exp(x * x) / (x + 1.0); }, std::exp(x0 * x0) / (x0 + 1),
      std::exp(x0 * x0) * (2 * x0 * (x0 + 1) - 1) / std::pow(x0 + 1, 2),
      std::exp(x0 * x0) * ((4 * x0 * x0 + 2) / (x0 + 1) - 4 * x0 / std::pow(x0 + 1, 2) + 2 / std::pow(x0 + 1, 3)));
}

TEST(DualFunctions, MixedSecondDerivatives) {
  const DD x = DD::variable(InTwo::variable(x0, 0), 0), y = DD::variable(InTwo::variable(y0, 1), 1);
  const DD f = exp(x * y) + x * x * y;
  const double e = std::exp(x0 * y0);
  EXPECT_NEAR(f.d[0].value, y0 * e + 2 * x0 * y0, 1e-14);
  EXPECT_NEAR(f.d[1].value, x0 * e + x0 * x0, 1e-14);
  EXPECT_NEAR(f.d[0].d[0], y0 * y0 * e + 2 * y0, 1e-14);
  EXPECT_NEAR(f.d[1].d[1], x0 * x0 * e, 1e-14);
  EXPECT_NEAR(f.d[0].d[1], e * (1 + x0 * y0) + 2 * x0, 1e-14);
  EXPECT_EQ(f.d[0].d[1], f.d[1].d[0]);
}

TEST(DualFunctions, ChoosingTakesTheDerivativesAlong) {
  const InTwo x = InTwo::variable(x0, 0), y = InTwo::variable(y0, 1);
  EXPECT_TRUE(y < x);
  EXPECT_TRUE(x > y);
  EXPECT_EQ(max(x, y).d[0], 1.0);
  EXPECT_EQ(min(x, y).d[1], 1.0);
  EXPECT_EQ(min(x, y).d[0], 0.0);
  EXPECT_EQ(select(y < x, y, x).d[1], 1.0);
  EXPECT_EQ(abs(-x).d[0], 1.0);
}

TEST(DualFunctions, CompoundAssignment) {
  InTwo x = InTwo::variable(x0, 0);
  const InTwo y = InTwo::variable(y0, 1);
  x += y;
  x *= y;
  x -= InTwo(1.0);
  x /= y;  // ((x + y) y - 1) / y = x + y - 1 / y
  EXPECT_NEAR(x.value, x0 + y0 - 1 / y0, 1e-15);
  EXPECT_NEAR(x.d[0], 1.0, 1e-15);
  EXPECT_NEAR(x.d[1], 1.0 + 1 / (y0 * y0), 1e-14);
}

TEST(DualOfPack, DifferentiatesEveryLane) {
  using P = Pack<4>;
  using DP = Dual<P, 1>;
  P x;
  for (int l = 0; l < 4; ++l) x.set(l, 0.5 + l);
  const DP variable = DP::variable(x, 0), f = sqrt(exp(variable) + 2.0) * log(variable) / variable;
  for (int l = 0; l < 4; ++l) {
    const Dual<double, 1> v = Dual<double, 1>::variable(x[l], 0), expected = sqrt(exp(v) + 2.0) * log(v) / v;
    EXPECT_NEAR(f.value[l], expected.value, 1e-14);
    EXPECT_NEAR(f.d[0][l], expected.d[0], 1e-13);
  }
}

}  // namespace
}  // namespace tunica
