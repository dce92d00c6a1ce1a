// Velocities on a mesh as phase-contrast MRI would show them: a series with a known truth.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "tunica/config/schema.hpp"
#include "tunica/flow_imaging/velocity_series.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::flow_imaging {

struct PhaseContrast {
  double voxel = 2e-3;  ///< m
  std::int64_t frames = 25;
  double encoding = 1.5;        ///< m/s
  double signal_to_noise = 10;  ///< of the magnitude of blood
  double tissue_signal = 0.6;   ///< of static tissue over that of blood
  double margin = 12e-3;        ///< of tissue around the vessel [m]
  double tilt = 0;              ///< of the image axes about (1, 1, 1) [rad]
  double background = 0;        ///< largest offset by eddy currents [m/s]
  std::int64_t seed = 1;

  static void add_to(config::Schema<PhaseContrast>& schema);
};

/// Velocity and places of the mesh at one instant, by node.
struct Instant {
  std::vector<Vec3<double>> points;    ///< m
  std::vector<Vec3<double>> velocity;  ///< m/s
};

/// Each voxel has the phase of the sum of its signals: that of blood by its velocities, that of tissue at rest in what
/// is left of it, and complex Gaussian noise; so velocities beyond `encoding` wrap, and voxels at the wall mix. Axes of
/// the image are those along which velocities are encoded; `period` [s]: frames are equal parts of it; `at(k)`: of
/// frame k. An offset that is linear in space reaches `background` at the corners. Magnitudes are means over the
/// frames.
VelocitySeries phase_contrast(const mesh::MeshData& data, const PhaseContrast& settings, double period,
                              const std::function<Instant(std::size_t)>& at);

}  // namespace tunica::flow_imaging
