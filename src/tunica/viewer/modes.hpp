// A quantity over time as a mean and a few modes (proper orthogonal decomposition), in whole numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tunica::viewer {

/// How far values differ from those that were given, as shares of their range (largest less smallest of all times).
struct Deviation {
  double most = 0;     ///< 99.9 % of the values differ by no more than this
  double largest = 0;  ///< any value
  double range = 0;    ///< in the unit of the values
};

/// value[i](t) = mean_step * mean[i] + sum over the modes of weights[t] * step * values[i].
struct Modes {
  struct Mode {
    std::vector<std::int16_t> values;
    double step = 0;
    std::vector<double> weights;  ///< [time], no larger than one
  };
  std::vector<std::int16_t> mean;
  double mean_step = 0;
  std::vector<Mode> modes;
  Deviation deviation;  ///< measured with the whole numbers, as they are read again
};

/// As few modes as keep 99.9 % of the values within `tolerance` (0 to 1) of the range, of the singular value
/// decomposition of frames less their mean (Sirovich 1987, method of snapshots). `frames`: [time][value], equally long
/// and finite. Where whole numbers of 16 bits are too coarse for that, `deviation` says how far it got.
Modes find_modes(const std::vector<std::vector<float>>& frames, double tolerance);

/// The values at one time.
std::vector<float> values_at(const Modes& modes, std::size_t frame);

/// Deviation of pairs of values; `range` of the true ones.
Deviation deviation_of(std::vector<float> differences, double range);

}  // namespace tunica::viewer
