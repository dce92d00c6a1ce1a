#include "tunica/viewer/modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tunica::viewer {

namespace {

constexpr double most_of_int16 = 32767;
/// Steps of a mode are this part of the tolerance, so that rounding many of them stays below it.
constexpr double steps_in_tolerance = 3;

using Frames = std::vector<std::vector<float>>;

std::vector<double> mean_of(const Frames& frames) {
  std::vector<double> mean(frames[0].size(), 0.0);
  for (const auto& frame : frames)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += frame[i];
  for (auto& m : mean) m /= static_cast<double>(frames.size());
  return mean;
}

double range_of(const Frames& frames) {
  float low = frames[0].empty() ? 0 : frames[0][0], high = low;
  for (const auto& frame : frames)
    for (const float v : frame) low = std::min(low, v), high = std::max(high, v);
  return static_cast<double>(high) - static_cast<double>(low);
}

std::vector<std::int16_t> rounded(const std::vector<double>& values, double step) {
  std::vector<std::int16_t> whole(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) whole[i] = static_cast<std::int16_t>(std::lround(values[i] / step));
  return whole;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Eigenvectors of the products of all pairs of frames: the courses of the modes in time, largest first.
Eigen::MatrixXd courses(const Frames& rest) {
  const auto n = static_cast<Eigen::Index>(rest.size());
  Eigen::MatrixXd products(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) {
      const auto &x = rest[static_cast<std::size_t>(a)], &y = rest[static_cast<std::size_t>(b)];
      double sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i) sum += static_cast<double>(x[i]) * static_cast<double>(y[i]);
      products(a, b) = products(b, a) = sum;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(products);
  return solver.eigenvectors().rowwise().reverse();
}

/// A mode of the frames less their mean, by its course in time.
Modes::Mode mode_of(const Frames& deviations, const Eigen::VectorXd& course, double finest_step) {
  std::vector<double> values(deviations[0].size(), 0.0);
  for (std::size_t t = 0; t < deviations.size(); ++t)
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += course[static_cast<Eigen::Index>(t)] * static_cast<double>(deviations[t][i]);
  const double most = course.cwiseAbs().maxCoeff();
  Modes::Mode mode;
  for (const double c : course) mode.weights.push_back(c / most);
  for (auto& v : values) v *= most;
  mode.step = std::max(finest_step, largest_of(values) / most_of_int16);
  mode.values = rounded(values, mode.step);
  return mode;
}

/// What is left of `rest` without the mode. Returns the root of the mean square.
double take_away(const Modes::Mode& mode, Frames& rest) {
  double squares = 0, count = 0;
  for (std::size_t t = 0; t < rest.size(); ++t) {
    const auto factor = static_cast<float>(mode.weights[t] * mode.step);
    for (std::size_t i = 0; i < rest[t].size(); ++i) {
      float& r = rest[t][i];
      r -= factor * static_cast<float>(mode.values[i]);
      squares += static_cast<double>(r) * static_cast<double>(r);
    }
    count += static_cast<double>(rest[t].size());
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

Deviation deviation_of_frames(const Frames& rest, double range) {
  std::vector<float> all;
  for (const auto& frame : rest) all.insert(all.end(), frame.begin(), frame.end());
  return deviation_of(std::move(all), range);
}

}  // namespace

Deviation deviation_of(std::vector<float> differences, double range) {
  Deviation d{0, 0, range};
  if (differences.empty() || range <= 0) return d;
  for (auto& x : differences) x = std::abs(x);
  const auto at =
      differences.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(differences.size() - 1));
  std::nth_element(differences.begin(), at, differences.end());
  d.most = static_cast<double>(*at) / range;
  d.largest = static_cast<double>(*std::max_element(at, differences.end())) / range;
  return d;
}

Modes find_modes(const Frames& frames, double tolerance) {
  Modes result;
  const auto mean = mean_of(frames);
  const double range = range_of(frames);
  const double finest = tolerance * range / steps_in_tolerance;
  result.mean_step = std::max({finest, largest_of(mean) / most_of_int16, 1e-30});
  result.mean = rounded(mean, result.mean_step);
  Frames rest = frames;
  for (auto& frame : rest)
    for (std::size_t i = 0; i < frame.size(); ++i)
      frame[i] -= static_cast<float>(result.mean_step * static_cast<double>(result.mean[i]));
  result.deviation = deviation_of_frames(rest, range);
  if (result.deviation.most <= tolerance || frames.size() < 2) return result;
  const Frames deviations = rest;
  const auto in_time = courses(deviations);
  for (Eigen::Index k = 0; k < in_time.cols(); ++k) {
    result.modes.push_back(mode_of(deviations, in_time.col(k), finest));
    // The 99.9 % of the differences are looked at once their mean is small: it takes as long as ten modes.
    if (take_away(result.modes.back(), rest) > 0.5 * tolerance * range && k + 1 < in_time.cols()) continue;
    result.deviation = deviation_of_frames(rest, range);
    if (result.deviation.most <= tolerance) break;
  }
  return result;
}

std::vector<float> values_at(const Modes& modes, std::size_t frame) {
  std::vector<float> values(modes.mean.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(modes.mean_step * static_cast<double>(modes.mean[i]));
  for (const auto& mode : modes.modes)
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] += static_cast<float>(mode.weights[frame] * mode.step * static_cast<double>(mode.values[i]));
  return values;
}

}  // namespace tunica::viewer
