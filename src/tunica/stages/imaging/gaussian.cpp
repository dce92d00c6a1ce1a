#include "tunica/stages/imaging/gaussian.hpp"

#include <cmath>

namespace tunica::stages::imaging {

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

/// Convolves along one axis; values beyond the ends are 0.
void filter(const ImageFrame& frame, int axis, const std::vector<float>& weights, std::vector<float>& values) {
  const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? frame.size[0] : frame.size[0] * frame.size[1];
  const std::int64_t n = frame.size[axis], reach = std::ssize(weights) / 2;
  std::vector<float> line(n + 2 * reach, 0.0F);
  for (std::int64_t start = 0; start < frame.count(); ++start) {
    if (frame.voxel(start)[axis] != 0) continue;
    for (std::int64_t i = 0; i < n; ++i) line[reach + i] = values[start + i * stride];
    for (std::int64_t i = 0; i < n; ++i) {
      float sum = 0;
      for (std::size_t w = 0; w < weights.size(); ++w) sum += weights[w] * line[i + w];
      values[start + i * stride] = sum;
    }
  }
}

}  // namespace

void blur(const ImageFrame& frame, double sigma, std::vector<float>& values) {
  const auto weights = kernel(sigma);
  for (int axis = 0; axis < 3; ++axis) filter(frame, axis, weights, values);
}

}  // namespace tunica::stages::imaging
