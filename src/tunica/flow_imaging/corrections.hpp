// What has to be put right in phase-contrast velocities before anything is measured in them: wrapped velocities, the
// offset that eddy currents leave, and how noisy they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tunica/flow_imaging/velocity_series.hpp"

namespace tunica::flow_imaging {

/// Adds multiples of twice the encoding velocity to voxels of `mask`, so that neighbours in space and time differ by
/// less than the encoding velocity wherever they can: regions grow from the slowest voxel of the slowest frame, across
/// the smallest difference first (a spanning tree by quality, Prim). Frames go round. Returns how many components of
/// voxels and frames were changed. Without an encoding velocity nothing is done.
std::int64_t unwrap(VelocitySeries& series, const std::vector<std::uint8_t>& mask);

/// Voxels that do not move: outside `not_static` (the vessel and what is near it), bright where there is a magnitude,
/// and no more restless over the beat than most of these (Walker et al. 1993, J. Magn. Reson. Imaging 3, 521-530).
std::vector<std::int64_t> static_tissue(const VelocitySeries& series, const std::vector<std::uint8_t>& not_static);

/// An offset of the velocities that is constant in time: a polynomial in space for each component.
struct Offset {
  int order = 0;
  std::array<std::vector<double>, 3> coefficients;  ///< of the monomials, places scaled to [-1, 1] in the image [m/s]
  double largest = 0;                               ///< within the image [m/s]
};

/// Fits the mean velocities of voxels at rest by least squares, those beyond three standard deviations left out the
/// second time. `order`: 0 to 3. Throws InputError when there are fewer than 20 such voxels for each coefficient.
Offset fit_offset(const VelocitySeries& series, const std::vector<std::int64_t>& at_rest, int order);
/// Takes it from all velocities.
void subtract(VelocitySeries& series, const Offset& offset);

/// How uncertain the velocity of a voxel is.
struct Noise {
  double deviation = 0;  ///< standard deviation of a component in static tissue [m/s]
  double magnitude = 0;  ///< mean magnitude there; 0: none was given

  /// Of a voxel of this magnitude: phase noise falls as the signal rises.
  double at(double voxel_magnitude) const {
    return magnitude > 0 && voxel_magnitude > 0 ? deviation * magnitude / voxel_magnitude : deviation;
  }
};
/// From the course of voxels at rest over the frames. Throws InputError with fewer than two frames or 100 voxels.
Noise measure_noise(const VelocitySeries& series, const std::vector<std::int64_t>& at_rest);

}  // namespace tunica::flow_imaging
