// Flow through sections over the beat, with its uncertainty, and what mass says of several of them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/flow_imaging/profile_fit.hpp"

namespace tunica::flow_imaging {

struct FlowCurve {
  std::string name;
  Vec3<double> centre{}, normal{};  ///< of the section [m], unit
  double area = 0;                  ///< m^2
  std::size_t voxels = 0;           ///< that tell the flow
  std::vector<double> flow;         ///< of each frame along the normal [m^3/s]
  std::vector<double> deviation;    ///< standard deviation of each of them by the noise of the voxels [m^3/s]
  double deviation_of_mean = 0;     ///< of the mean over the beat, by the noise alone [m^3/s]
  /// Relative, what voxels cannot resolve: half the square of voxel over radius, the error of a parabola's mean over
  /// voxels; the same in all frames.
  double unresolved = 0;

  double mean() const;                           ///< over the beat; frames are weighted by the time they stand for
  double mean_deviation() const;                 ///< of it, of both causes
  double deviation_at(std::size_t frame) const;  ///< of a frame, of both causes
  double deviation_by_noise() const;             ///< root mean square of that of the frames by the noise alone
  std::vector<double> weights{};                 ///< of the frames, sum 1
};

/// Share of the period that each frame stands for: half of the way to the frames before and after, round the period.
std::vector<double> frame_weights(const std::vector<double>& times, double period);

FlowCurve flow_curve(const VelocitySeries& series, const ProfileFit& fit, const CrossSection& section);

/// Makes the sums of the mean flows zero, where `signs[k]` is +-1 for a curve that takes part and 0 for another one:
/// each mean is moved by its share of the sum of all variances, the same at all frames (weighted least squares).
/// Returns what was left of mass before [m^3/s].
double balance_means(std::span<FlowCurve> curves, std::span<const int> signs);

}  // namespace tunica::flow_imaging
