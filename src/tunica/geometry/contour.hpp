// Iso-surfaces of sampled functions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// Samples on a regular grid, x fastest.
struct Grid {
  Point origin;    ///< of the first sample [m]
  double spacing;  ///< [m]
  std::array<std::int64_t, 3> size;
  std::vector<float> values;

  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const { return i + size[0] * (j + size[1] * k); }
  Point place(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin + spacing * Vec3<double>{{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}};
  }
};

/// Surface of value 0 with normals towards positive values.
TriangleSurface zero_surface(const Grid& grid);

}  // namespace tunica::geometry
