#include "tunica/imaging/distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tunica::imaging {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Lower envelope of the parabolas that stand on the samples of a row: the smallest value + (distance)^2.
class Envelope {
 public:
  explicit Envelope(std::int64_t longest) : foot_(longest), bound_(longest + 1), row_(longest) {}

  void apply(float* values, std::int64_t count, std::int64_t stride, float step) {
    std::int64_t last = -1;
    const float square = step * step;
    for (std::int64_t q = 0; q < count; ++q) {
      row_[q] = values[q * stride];
      if (row_[q] == infinite) continue;
      float from = -infinite;
      while (last >= 0) {
        const auto p = foot_[last];
        from = ((row_[q] - row_[p]) / square + static_cast<float>(q * q - p * p)) / static_cast<float>(2 * (q - p));
        if (from > bound_[last]) break;
        --last;
        from = -infinite;
      }
      foot_[++last] = q;
      bound_[last] = from;
    }
    if (last < 0) return;
    bound_[last + 1] = infinite;
    for (std::int64_t q = 0, k = 0; q < count; ++q) {
      while (bound_[k + 1] < static_cast<float>(q)) ++k;
      const auto off = static_cast<float>(q - foot_[k]);
      values[q * stride] = row_[foot_[k]] + square * off * off;
    }
  }

 private:
  std::vector<std::int64_t> foot_;
  std::vector<float> bound_, row_;
};

std::vector<float> distance_along(const ImageFrame& frame, const VoxelSet& set, std::uint8_t member, int without) {
  std::vector<float> values(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) values[i] = set[i] == member ? 0 : infinite;
  Envelope envelope(*std::max_element(frame.size.begin(), frame.size.end()));
  const std::int64_t strides[3] = {1, frame.size[0], frame.size[0] * frame.size[1]};
  for (int d = 0; d < 3; ++d) {
    if (d == without) continue;
    const auto step = static_cast<float>(norm(frame.steps[d]));
    const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
    for (std::int64_t j = 0; j < frame.size[b]; ++j)
      for (std::int64_t i = 0; i < frame.size[a]; ++i)
        envelope.apply(values.data() + i * strides[a] + j * strides[b], frame.size[d], strides[d], step);
  }
  for (auto& v : values) v = std::sqrt(v);
  return values;
}

std::vector<float> signed_along(const ImageFrame& frame, const VoxelSet& set, int without) {
  auto outside = distance_along(frame, set, 1, without);
  const auto inside = distance_along(frame, set, 0, without);
  float half = infinite;
  for (int d = 0; d < 3; ++d)
    if (d != without) half = std::min(half, 0.5F * static_cast<float>(norm(frame.steps[d])));
  for (std::size_t i = 0; i < set.size(); ++i) outside[i] = set[i] ? half - inside[i] : outside[i] - half;
  return outside;
}

}  // namespace

std::vector<float> distance_to(const ImageFrame& frame, const VoxelSet& set) {
  return distance_along(frame, set, 1, -1);
}

std::vector<float> signed_distance(const ImageFrame& frame, const VoxelSet& set) {
  return signed_along(frame, set, -1);
}

std::vector<float> signed_distance_in_slices(const ImageFrame& frame, const VoxelSet& set, int axis) {
  return signed_along(frame, set, axis);
}

}  // namespace tunica::imaging
