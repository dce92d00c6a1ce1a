// A pulsating parabola in a straight tube, whose flow is known.
#pragma once

#include <cmath>

#include "tunica/flow_imaging/synthetic_series.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::flow_imaging {

struct TubeFlow {
  mesh::MeshData mesh;
  double radius = 10e-3, period = 0.8, mean_speed = 0.25;  ///< m, s, of the mean over time on the axis [m/s]

  TubeFlow() {
    mesh::TubeSizes sizes;
    sizes.radius = radius;
    sizes.length = 50e-3;
    sizes.cells_around = 32;
    sizes.cells_radial = 4;
    sizes.cells_along = 20;
    mesh = mesh::tube(sizes);
  }
  /// On the axis [m/s]; `pulse`: its amplitude over its mean.
  double axial(double t, double pulse = 1.2) const {
    return mean_speed * (1 + pulse * std::sin(2 * M_PI * t / period));
  }
  Instant at(double t, double pulse = 1.2) const {
    Instant instant{.points = mesh.points, .velocity = {}};
    for (const auto& x : mesh.points) {
      const double r = std::hypot(x[0], x[1]) / radius;
      instant.velocity.push_back({{0, 0, axial(t, pulse) * std::max(0.0, 1 - r * r)}});
    }
    return instant;
  }
  VelocitySeries imaged(const PhaseContrast& scan, double pulse = 1.2) const {
    return phase_contrast(mesh, scan, period, [&](std::size_t k) {
      return at(period * static_cast<double>(k) / static_cast<double>(scan.frames), pulse);
    });
  }
};

}  // namespace tunica::flow_imaging
