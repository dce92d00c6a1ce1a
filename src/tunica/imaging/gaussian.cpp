#include "tunica/imaging/gaussian.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::imaging {

namespace {

std::vector<float> kernel(double sigma) {
  const int reach = static_cast<int>(std::ceil(3.5 * sigma));
  std::vector<float> weights;
  float sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += weights.back();
  }
  for (auto& w : weights) w /= sum;
  return weights;
}

/// Convolves along one axis, row by row: rows along x lie in one piece.
void filter(const ImageFrame& frame, int axis, const std::vector<float>& weights, std::vector<float>& values) {
  const auto from = values;
  const std::int64_t n = frame.size[axis], reach = std::ssize(weights) / 2, width = frame.size[0];
  const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? width : width * frame.size[1];
  for (std::int64_t row = 0; row < frame.count(); row += width) {
    float* to = values.data() + row;
    std::fill(to, to + width, 0.0F);
    const std::int64_t at = frame.voxel(row)[axis];
    for (std::int64_t shift = -reach; shift <= reach; ++shift) {
      if (axis != 0 && (at + shift < 0 || at + shift >= n)) continue;
      const float* source = from.data() + row + shift * stride;
      const float weight = weights[shift + reach];
      const std::int64_t first = axis == 0 ? std::max<std::int64_t>(0, -shift) : 0;
      const std::int64_t end = axis == 0 ? std::min(width, width - shift) : width;
      for (std::int64_t i = first; i < end; ++i) to[i] += weight * source[i];
    }
  }
}

}  // namespace

void blur(const ImageFrame& frame, double sigma, std::vector<float>& values) {
  const auto weights = kernel(sigma);
  for (int axis = 0; axis < 3; ++axis) filter(frame, axis, weights, values);
}

}  // namespace tunica::imaging
