// Labelled images of bodies that are known exactly.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging::testing {

inline constexpr double mm = 1e-3;
using Label = std::function<int(const Point&)>;

/// Image of `voxels` on each side about the origin.
inline LabelImage image_of(const Label& label, const Size3& voxels, const std::array<Vec3<double>, 3>& steps) {
  LabelImage image{{voxels, {{0, 0, 0}}, steps}, {}};
  for (int d = 0; d < 3; ++d)
    image.frame.origin = image.frame.origin - (0.5 * static_cast<double>(voxels[d] - 1)) * steps[d];
  for (std::int64_t i = 0; i < image.frame.count(); ++i)
    image.labels.push_back(static_cast<std::int16_t>(label(image.frame.place(image.frame.voxel(i)))));
  return image;
}

inline constexpr std::array<Vec3<double>, 3> straight = {{{{0.7 * mm, 0, 0}}, {{0, 0.7 * mm, 0}}, {{0, 0, 0.7 * mm}}}};

/// Turned, unequal and left-handed.
inline std::array<Vec3<double>, 3> oblique() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  return {{{{0.6 * mm * c, 0.6 * mm * s, 0}}, {{-0.7 * mm * s, 0.7 * mm * c, 0}}, {{0, 0, -0.9 * mm}}}};
}

inline void silent(const std::string&) {}

}  // namespace tunica::imaging::testing
