// The filter of images against the sampled Gaussian.
#include "tunica/imaging/gaussian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace tunica::imaging {
namespace {

ImageFrame grid(const Size3& size) { return {size, {{0, 0, 0}}, {{{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}}}}; }

/// Normalised weights at whole voxels up to 3.5 standard deviations, rounded up.
double weight(int offset, double sigma) {
  const int reach = static_cast<int>(std::ceil(3.5 * sigma));
  if (std::abs(offset) > reach) return 0;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  return std::exp(-0.5 * offset * offset / (sigma * sigma)) / sum;
}

std::vector<float> impulse(const ImageFrame& frame, const Size3& at) {
  std::vector<float> values(static_cast<std::size_t>(frame.count()), 0.0F);
  values[static_cast<std::size_t>(frame.index(at[0], at[1], at[2]))] = 1;
  return values;
}

TEST(Gaussian, AnImpulseBecomesTheProductOfThreeBells) {
  const auto frame = grid({13, 11, 15});
  const Size3 at{6, 5, 7};
  auto values = impulse(frame, at);
  blur(frame, 1.1, values);
  double sum = 0;
  for (std::int64_t i = 0; i < frame.count(); ++i) {
    const auto v = frame.voxel(i);
    double expected = 1;
    for (int d = 0; d < 3; ++d) expected *= weight(static_cast<int>(v[d] - at[d]), 1.1);
    EXPECT_NEAR(values[static_cast<std::size_t>(i)], expected, 1e-7) << v[0] << " " << v[1] << " " << v[2];
    sum += values[static_cast<std::size_t>(i)];
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(Gaussian, WhatLiesBeyondTheImageCountsAsNothing) {
  const auto frame = grid({9, 9, 9});
  std::vector<float> values(static_cast<std::size_t>(frame.count()), 1.0F);
  blur(frame, 1, values);
  // At a border half of the bell and half of its middle are left, along each axis that ends there.
  const double half = 0.5 * (1 + weight(0, 1));
  EXPECT_NEAR(values[static_cast<std::size_t>(frame.index(4, 4, 4))], 1, 1e-6);
  EXPECT_NEAR(values[static_cast<std::size_t>(frame.index(0, 4, 4))], half, 1e-6);
  EXPECT_NEAR(values[static_cast<std::size_t>(frame.index(4, 8, 0))], half * half, 1e-6);
  EXPECT_NEAR(values[static_cast<std::size_t>(frame.index(8, 0, 8))], half * half * half, 1e-6);
}

TEST(Gaussian, KeepsWhatIsLinear) {
  const auto frame = grid({14, 15, 16});
  std::vector<float> values;
  const auto function = [](const Size3& v) {
    return static_cast<float>(0.3 + 0.02 * static_cast<double>(v[0]) - 0.05 * static_cast<double>(v[1]) +
                              0.01 * static_cast<double>(v[2]));
  };
  for (std::int64_t i = 0; i < frame.count(); ++i) values.push_back(function(frame.voxel(i)));
  blur(frame, 1.3, values);
  for (std::int64_t k = 5; k < 11; ++k)
    for (std::int64_t j = 5; j < 10; ++j)
      for (std::int64_t i = 5; i < 9; ++i)
        EXPECT_NEAR(values[static_cast<std::size_t>(frame.index(i, j, k))], function({i, j, k}), 1e-6);
}

TEST(Gaussian, VariancesAddUp) {
  const auto frame = grid({41, 1, 1});
  auto twice = impulse(frame, {20, 0, 0}), once = twice;
  // Across the thin axes an image of one voxel keeps the middle weight alone.
  const auto thin = [&](double sigma) { return static_cast<float>(1 / std::pow(weight(0, sigma), 2)); };
  blur(frame, 1.5, twice);
  for (auto& v : twice) v *= thin(1.5);
  blur(frame, 2.0, twice);
  for (auto& v : twice) v *= thin(2.0);
  blur(frame, 2.5, once);
  for (auto& v : once) v *= thin(2.5);
  double variance = 0;
  for (int i = 0; i < 41; ++i) {
    EXPECT_NEAR(twice[static_cast<std::size_t>(i)], once[static_cast<std::size_t>(i)], 1e-3);
    variance += (i - 20) * (i - 20) * twice[static_cast<std::size_t>(i)];
  }
  EXPECT_NEAR(variance, 1.5 * 1.5 + 2 * 2, 0.07);  // tails are cut off
}

}  // namespace
}  // namespace tunica::imaging
