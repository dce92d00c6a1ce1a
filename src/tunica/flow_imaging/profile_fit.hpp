// The velocity in a section of a lumen from the noisy voxels about it.
//
// The profile is a Gaussian process that vanishes on the rim, with a correlation length in the plane and three times as
// much along the normal, beside a share of a profile of steady flow that is hardly known beforehand (an explicit basis
// function: eq. 2.39-2.41); voxels are means of it over the part of them that lies in the lumen, diluted by the tissue
// in the rest. Frames are no profiles of their own: blood moves in a few courses over the beat, the principal
// components of the voxels, and noise in all frames alike. Each course that stands out of the noise has a profile, the
// larger its variance the less smoothed; what is left is not fitted. For given courses the fit is linear in the voxels:
// a flow is a sum of weights times voxels, and so its uncertainty follows from theirs (Rasmussen & Williams 2006,
// Gaussian Processes for Machine Learning, eq. 2.23-2.26).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tunica/flow_imaging/corrections.hpp"
#include "tunica/flow_imaging/cross_section.hpp"
#include "tunica/flow_imaging/lumen_samples.hpp"

namespace tunica::flow_imaging {

struct FitSettings {
  std::optional<double> length{};  ///< of correlation in the plane [m]; none: half the radius of the section's area
  double slab = 1.5;               ///< voxels before and behind the plane that are taken, in their largest spacing
  bool at_end = false;             ///< the mesh ends in the section, the vessel does not: voxels across it are left out
};

/// The lumen on the voxels of a series, once for all sections.
struct LumenVoxels {
  std::vector<LumenSample> samples;
  std::vector<Vec3<double>> places;  ///< of the samples [m]
  std::vector<float> shares;
  double blood_magnitude = 0;  ///< mean in voxels that lie in the lumen; 0: no magnitude
  double tissue_signal = 1;    ///< magnitude of static tissue over that of blood; 1 without a magnitude
};
LumenVoxels lumen_voxels(const VelocitySeries& series, const mesh::MeshData& data, double tissue_magnitude);

/// A fitted section, ready for any frame.
class ProfileFit {
 public:
  /// Throws InputError when fewer than six voxels lie in the section: it is too narrow for the image, or beyond it.
  ProfileFit(const VelocitySeries& series, const LumenVoxels& lumen, const CrossSection& section, const Noise& noise,
             const FitSettings& settings);

  std::size_t voxels() const { return observations_.size(); }
  double length() const { return length_; }                  ///< m
  const std::vector<double>& flow() const { return flow_; }  ///< of each frame along the normal [m^3/s]
  /// Standard deviation of a weighted sum of the frames' flows, by the noise of the voxels [m^3/s].
  double flow_deviation(std::span<const double> of_frames) const;
  /// The velocities of all frames at a place of the section [m/s].
  std::vector<Vec3<double>> velocities(const Vec3<double>& at) const;

 private:
  struct Place {
    double x, y, z;  ///< in the plane, and along the normal [m]
    double steady;   ///< of a profile of steady flow there: 1 in the middle, 0 on the rim
  };
  /// A part of a voxel that lies in the section's column: mean place, share of the voxel's value.
  struct Part {
    Place at;
    double weight;
  };
  struct Observation {
    std::int64_t voxel;
    std::vector<Part> parts;
    double deviation;  ///< m/s
  };
  void gather(const LumenVoxels& lumen, double slab, bool at_end);
  void place_rim();
  struct Courses;
  void find_courses();
  void find_flow();
  Place place(const std::array<double, 2>& in_plane, double height) const;
  void find_radius();
  double correlation(const Place& a, const Place& b) const;
  double correlation(const Observation& o, const Place& at) const;
  std::vector<double> correlations(const Place& at) const;

  const VelocitySeries& series_;
  const CrossSection& section_;
  SectionColumn column_;
  Noise noise_;
  double radius_ = 0;  ///< largest distance from the rim [m]
  double length_;      ///< m
  std::vector<Observation> observations_;
  std::vector<Place> rim_;
  std::shared_ptr<const Courses> along_, across_;  ///< of the velocities along and across the normal
  std::vector<double> flow_;
  std::vector<double> flow_variances_;  ///< of the flow of each course along the normal, by the noise [m^6/s^2]
};

}  // namespace tunica::flow_imaging
