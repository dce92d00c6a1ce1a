// The mesh of a lumen on the voxels of an image: which parts of each voxel lie in it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::flow_imaging {

/// Voxels are sampled at so many points along each axis.
inline constexpr int samples_along = 4;
inline constexpr int samples_in_voxel = samples_along * samples_along * samples_along;

/// A sample point that lies in the lumen.
struct LumenSample {
  std::int64_t voxel;
  std::int64_t element;               ///< number in `tetrahedra`
  std::array<double, 4> barycentric;  ///< there
};

/// All samples in the tetrahedra (corners, of `points` [m]), each once, by their voxel.
std::vector<LumenSample> lumen_samples(const imaging::ImageFrame& frame, std::span<const Vec3<double>> points,
                                       std::span<const std::array<std::int64_t, 4>> tetrahedra);

/// Share of each voxel that lies in the lumen, 0 to 1.
std::vector<float> lumen_shares(const imaging::ImageFrame& frame, const std::vector<LumenSample>& samples);

/// Voxels within `steps` voxels of one that has a share, by faces; those included. One entry each.
std::vector<std::uint8_t> near_lumen(const imaging::ImageFrame& frame, const std::vector<float>& shares, int steps);

}  // namespace tunica::flow_imaging
