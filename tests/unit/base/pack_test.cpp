#include "tunica/base/pack.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

#include "power_of_two.hpp"

namespace tunica {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

template <class P>
class EveryWidth : public testing::Test {};
using Widths = testing::Types<Pack<2>, Pack<4>, Pack<8>>;
TYPED_TEST_SUITE(EveryWidth, Widths);

/// A pack of the values f(0), f(1), ...
template <class P, class F>
P pack(F f) {
  P r;
  for (int l = 0; l < P::width; ++l) r.set(l, f(l));
  return r;
}

/// Distance from the true value in units in its last place.
double ulps(double value, long double exact) {
  const double nearest = static_cast<double>(exact);
  if (value == nearest) return 0.0;
  const double unit = std::nextafter(std::fabs(nearest), inf) - std::fabs(nearest);
  return static_cast<double>(std::fabs((value - exact) / unit));
}

TYPED_TEST(EveryWidth, ArithmeticIsTheScalarsLaneByLane) {
  using P = TypeParam;
  static_assert(sizeof(P) == P::width * sizeof(double));
  static_assert(std::is_trivially_copyable_v<P>);
  const P a = pack<P>([](int l) { return 1.5 + l; }), b = pack<P>([](int l) { return 7.0 - 2.0 * l; });
  P sum = a, difference = a, product = a, quotient = a;
  sum += b;
  difference -= b;
  product *= b;
  quotient /= b;
  const P minus = -a, mixed = 2.0 * a + 1.0;
  for (int l = 0; l < P::width; ++l) {
    const double x = a[l], y = b[l];
    EXPECT_EQ((a + b)[l], x + y);
    EXPECT_EQ((a - b)[l], x - y);
    EXPECT_EQ((a * b)[l], x * y);
    EXPECT_EQ((a / b)[l], x / y);
    EXPECT_EQ(sum[l], x + y);
    EXPECT_EQ(difference[l], x - y);
    EXPECT_EQ(product[l], x * y);
    EXPECT_EQ(quotient[l], x / y);
    EXPECT_EQ(minus[l], -x);
    EXPECT_EQ(mixed[l], 2.0 * x + 1.0);
  }
}

TYPED_TEST(EveryWidth, LoadsStoresAndLanes) {
  using P = TypeParam;
  double values[P::width + 1], back[P::width + 1] = {};
  for (int l = 0; l <= P::width; ++l) values[l] = 0.1 * l;
  const P p = P::load(values + 1);  // unaligned
  p.store(back + 1);
  for (int l = 0; l < P::width; ++l) {
    EXPECT_EQ(p[l], values[l + 1]);
    EXPECT_EQ(back[l + 1], values[l + 1]);
    EXPECT_EQ(lane(p, l), p[l]);
    EXPECT_EQ(P(3.0)[l], 3.0);
  }
  EXPECT_EQ(back[0], 0.0);
  P q = p;
  set_lane(q, P::width - 1, -4.0);
  EXPECT_EQ(q[P::width - 1], -4.0);
  EXPECT_EQ(q[0], p[0]);
  static_assert(lanes<P> == P::width && lanes<double> == 1);
}

TYPED_TEST(EveryWidth, ChoosesLaneByLane) {
  using P = TypeParam;
  const P a = pack<P>([](int l) { return l % 2 ? 1.0 * l : -1.0 * l; }), b(0.5);
  const P chosen = select(a < b, a, b), larger = max(a, b), smaller = min(a, b), size = abs(a);
  for (int l = 0; l < P::width; ++l) {
    EXPECT_EQ(chosen[l], a[l] < 0.5 ? a[l] : 0.5);
    EXPECT_EQ(larger[l], std::fmax(a[l], 0.5));
    EXPECT_EQ(smaller[l], std::fmin(a[l], 0.5));
    EXPECT_EQ(size[l], std::fabs(a[l]));
    EXPECT_EQ((a > b)[l] != 0, a[l] > 0.5);
  }
  EXPECT_FALSE(any(P(1.0) < P(0.0)));
  for (int l = 0; l < P::width; ++l) {
    P one(1.0);
    one.set(l, -1.0);
    EXPECT_TRUE(any(one < P(0.0)));
  }
  // A comparison with NaN is false.
  EXPECT_FALSE(any(P(nan) < P(0.0)));
  EXPECT_FALSE(any(P(nan) > P(0.0)));
}

TYPED_TEST(EveryWidth, SquareRootIsExactlyRounded) {
  using P = TypeParam;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> exponent(-700, 700);
  for (int i = 0; i < 1000; ++i) {
    const P x = pack<P>([&](int) { return std::exp(exponent(engine)); }), s = sqrt(x);
    for (int l = 0; l < P::width; ++l) EXPECT_EQ(s[l], std::sqrt(x[l]));
  }
  const P special = sqrt(pack<P>([](int l) { return l % 2 ? inf : 0.0; }));
  EXPECT_EQ(special[0], 0.0);
  EXPECT_EQ(special[1], inf);
  EXPECT_TRUE(std::isnan(sqrt(P(-1.0))[0]));
}

TYPED_TEST(EveryWidth, ExponentialIsWithinOneUlp) {
  using P = TypeParam;
  std::mt19937 engine(2);
  double worst = 0.0;
  for (double range : {708.0, 30.0, 1.0, 1e-3, 1e-12, 1e-300}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 4000; ++i) {
      const P x = pack<P>([&](int) { return uniform(engine); }), y = exp(x);
      for (int l = 0; l < P::width; ++l) worst = std::fmax(worst, ulps(y[l], std::exp(static_cast<long double>(x[l]))));
    }
  }
  testing::Test::RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LT(worst, 1.0);
}

TYPED_TEST(EveryWidth, ExponentialOfSpecialValues) {
  using P = TypeParam;
  EXPECT_EQ(exp(P(0.0))[0], 1.0);
  EXPECT_EQ(exp(P(-0.0))[0], 1.0);
  EXPECT_EQ(exp(P(inf))[1], inf);
  EXPECT_EQ(exp(P(1e300))[1], inf);
  EXPECT_EQ(exp(P(709.1))[1], inf);
  EXPECT_EQ(exp(P(-inf))[1], 0.0);
  EXPECT_EQ(exp(P(-1e300))[1], 0.0);
  EXPECT_EQ(exp(P(-708.1))[1], 0.0);
  EXPECT_TRUE(std::isnan(exp(P(nan))[0]));
}

/// `power(x, y)` sets y = 2^x for W numbers at once.
template <int W, class Power>
void expect_power_of_two(const Power& power) {
  double x[W], y[W], worst = 0.0;
  std::mt19937 engine(5);
  const auto compare = [&] {
    power(x, y);
    for (int l = 0; l < W; ++l) worst = std::fmax(worst, std::fabs(y[l] / std::exp2(x[l]) - 1.0));
  };
  for (double range : {1023.0, 30.0, 1.0, 1e-3, 1e-300}) {
    std::uniform_real_distribution<double> uniform(0.0, range);
    for (int i = 0; i < 4000; ++i) {
      for (double& value : x) value = uniform(engine);
      compare();
    }
  }
  for (double value : {0.0, 0.5, 1.0, 1.0 / 16, 3.0 / 16, std::nextafter(0.5, 0.0), 1022.75, 1023.0}) {
    std::fill_n(x, W, value);
    compare();
  }
  testing::Test::RecordProperty("worst", fmt::format("{:.2e}", worst));
  EXPECT_LT(worst, 3e-13);
  for (double large : {1023.5, 1e300, inf}) {
    std::fill_n(x, W, large);
    power(x, y);
    EXPECT_NEAR(y[W - 1] / 0x1p1023, 1.0, 3e-13);
  }
  x[1] = nan;
  power(x, y);
  EXPECT_TRUE(std::isnan(y[1]));
  EXPECT_GT(y[0], 1e300);
}

TYPED_TEST(EveryWidth, PowerOfTwoHasTwelveDigits) {
  using P = TypeParam;
  expect_power_of_two<P::width>([](const double* x, double* y) { exp2_of_nonnegative(P::load(x)).store(y); });
}

TEST(Scalar, PowerOfTwo) {
  EXPECT_EQ(exp2_of_nonnegative(2.5), std::exp2(2.5));
  EXPECT_EQ(exp2_of_nonnegative(1e300), 0x1p1023);
  EXPECT_TRUE(std::isnan(exp2_of_nonnegative(nan)));
}

TEST(InstructionSets, PowerOfTwoWithAvx2) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no AVX2";
  expect_power_of_two<4>(test::exp2_avx2);
}

TEST(InstructionSets, PowerOfTwoWithAvx512) {
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq")) GTEST_SKIP() << "no AVX-512";
  expect_power_of_two<8>(test::exp2_avx512);
}

TYPED_TEST(EveryWidth, LogarithmIsWithinTwoUlp) {
  using P = TypeParam;
  std::mt19937 engine(3);
  double worst = 0.0;
  const auto measure = [&worst](const P& x) {
    const P y = log(x);
    for (int l = 0; l < P::width; ++l) worst = std::fmax(worst, ulps(y[l], std::log(static_cast<long double>(x[l]))));
  };
  for (double range : {708.0, 40.0, 1.0, 1e-2, 1e-5, 1e-9}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 4000; ++i) measure(pack<P>([&](int) { return std::exp(uniform(engine)); }));
  }
  std::uniform_real_distribution<double> tiny(0.0, std::numeric_limits<double>::min());
  for (int i = 0; i < 1000; ++i) measure(pack<P>([&](int) { return tiny(engine); }));
  measure(P(std::numeric_limits<double>::min()));
  measure(P(std::numeric_limits<double>::max()));
  measure(P(std::numeric_limits<double>::denorm_min()));
  measure(P(std::sqrt(2.0)));
  measure(P(std::sqrt(0.5)));
  testing::Test::RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LT(worst, 2.0);
}

TYPED_TEST(EveryWidth, LogarithmOfSpecialValues) {
  using P = TypeParam;
  EXPECT_EQ(log(P(1.0))[0], 0.0);
  EXPECT_EQ(log(P(0.0))[0], -inf);
  EXPECT_EQ(log(P(inf))[1], inf);
  EXPECT_TRUE(std::isnan(log(P(-1.0))[0]));
  EXPECT_TRUE(std::isnan(log(P(-inf))[0]));
  EXPECT_TRUE(std::isnan(log(P(nan))[1]));
}

TYPED_TEST(EveryWidth, PowerAgreesWithTheScalar) {
  using P = TypeParam;
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> base(-20, 20), exponent(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const double y = exponent(engine);
    const P x = pack<P>([&](int) { return std::exp(base(engine)); }), z = pow(x, y);
    for (int l = 0; l < P::width; ++l)
      EXPECT_NEAR(z[l] / std::pow(x[l], y), 1.0, 3e-16 * (2.0 + std::fabs(y * std::log(x[l]))));
  }
  EXPECT_EQ(pow(P(0.0), 1.25)[0], 0.0);
  EXPECT_EQ(pow(P(0.0), -0.5)[0], inf);
}

TYPED_TEST(EveryWidth, LanesDoNotDisturbEachOther) {
  using P = TypeParam;
  P x(2.0);
  x.set(0, nan);
  x.set(1, -inf);
  const P e = exp(x), l = log(x), s = sqrt(x);
  EXPECT_TRUE(std::isnan(e[0]));
  EXPECT_EQ(e[1], 0.0);
  for (int i = 2; i < P::width; ++i) {
    EXPECT_LT(ulps(e[i], std::exp(2.0L)), 2.0);
    EXPECT_LT(ulps(l[i], std::log(2.0L)), 2.0);
    EXPECT_EQ(s[i], std::sqrt(2.0));
  }
}

TEST(Scalar, TwinsBehaveLikePacks) {
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, 1.0, 2.0), 2.0);
  EXPECT_EQ(max(1.0, 2.0), 2.0);
  EXPECT_EQ(min(1.0, 2.0), 1.0);
  EXPECT_EQ(abs(-1.5), 1.5);
  EXPECT_EQ(sqrt(4.0), 2.0);
  EXPECT_EQ(pow(2.0, 3.0), 8.0);
  EXPECT_TRUE(any(true));
  double x = 0.0;
  set_lane(x, 0, 3.0);
  EXPECT_EQ(lane(x, 0), 3.0);
}

}  // namespace
}  // namespace tunica
