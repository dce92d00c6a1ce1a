#include "tunica/viewer/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tunica::viewer {
namespace {

/// 10 + two shapes with courses of their own, and a third that is `small` times as large.
std::vector<std::vector<float>> beat(double small) {
  std::vector<std::vector<float>> frames;
  for (int t = 0; t < 30; ++t) {
    auto& frame = frames.emplace_back();
    const double phase = 2 * M_PI * t / 30;
    for (int i = 0; i < 2000; ++i) {
      const double x = i / 2000.0;
      frame.push_back(static_cast<float>(10 + std::sin(phase) * std::cos(3 * x) + 0.5 * std::cos(2 * phase) * x * x +
                                         small * std::sin(5 * phase) * std::sin(40 * x)));
    }
  }
  return frames;
}

TEST(Modes, AreAsManyAsThereAreCourses) {
  EXPECT_EQ(find_modes(beat(0), 0.002).modes.size(), 2U);
  EXPECT_EQ(find_modes(beat(0.2), 0.002).modes.size(), 3U);
  EXPECT_EQ(find_modes(beat(1e-4), 0.002).modes.size(), 2U);  // less than the tolerance
}

TEST(Modes, KeepWhatTheySayOfTheirDeviation) {
  const auto frames = beat(0.05);
  for (const double tolerance : {0.05, 0.005, 0.0005}) {
    const Modes modes = find_modes(frames, tolerance);
    EXPECT_LE(modes.deviation.most, tolerance);
    double largest = 0;
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const auto values = values_at(modes, t);
      for (std::size_t i = 0; i < values.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(values[i]) - static_cast<double>(frames[t][i])));
    }
    EXPECT_NEAR(largest / modes.deviation.range, modes.deviation.largest, 1e-5);
  }
}

TEST(Modes, OfWhatDoesNotChangeAreNone) {
  const Modes modes = find_modes({{1.0F, -2.0F, 3.0F}, {1.0F, -2.0F, 3.0F}}, 0.001);
  EXPECT_TRUE(modes.modes.empty());
  EXPECT_NEAR(values_at(modes, 1)[1], -2.0, 1e-4);
  EXPECT_TRUE(find_modes({{0.0F, 0.0F}, {0.0F, 0.0F}}, 0.001).modes.empty());
}

TEST(Modes, DeviationIsThatOfAlmostAll) {
  std::vector<float> differences(10000, 0.01F);
  differences[17] = -3.0F;
  const auto d = deviation_of(differences, 2.0);
  EXPECT_NEAR(d.most, 0.005, 1e-6);
  EXPECT_NEAR(d.largest, 1.5, 1e-6);
}

}  // namespace
}  // namespace tunica::viewer
