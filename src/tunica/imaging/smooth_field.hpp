// A smooth function whose zero surface is the boundary of a voxelised lumen, between the voxels.
#pragma once

#include <vector>

#include "tunica/geometry/triangle_surface.hpp"
#include "tunica/imaging/lumen_mask.hpp"

namespace tunica::imaging {

struct SmoothField {
  ImageFrame frame;
  Mat3<double> to_voxels;     ///< from metres beyond the origin to voxels
  std::vector<float> values;  ///< < 0 in the lumen; about 1/2 far outside, -1/2 far inside

  /// Interpolated linearly; 1/2 beyond the frame.
  double at(const Point& place) const;
};

/// The lumen filtered by 2 G - G * G, G a Gaussian of standard deviation `sigma` [voxels], eq. (9.1). It moves curved
/// surfaces by less than half as much as G alone, eq. (9.2), and hardly thickens sheets of two to three voxels.
SmoothField smooth_field(const LumenMask& mask, double sigma);

/// Its zero surface with outward normals.
geometry::TriangleSurface boundary(const SmoothField& field);

}  // namespace tunica::imaging
