// How the wall of a lumen has moved between the phase of its mesh and another one: the surface of the mesh is laid onto
// where the lumen ends there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tunica/motion_imaging/lumen_boundary.hpp"

namespace tunica::motion_imaging {

/// The wall of the lumens (and ends of vessels that are seen in the images), triangles wound so that their normals
/// point out of the blood.
struct WallSurface {
  geometry::TriangleSurface surface;
  std::vector<Side> sides;  ///< of each triangle
};

struct MotionSettings {
  double smoothing = 4e-3;  ///< length below which motion is taken for noise [m]
  double reach = 6e-3;      ///< motion beyond what was found so far that is looked for [m]
};

/// Displacement of the points of a surface at one phase.
struct WallMotion {
  std::vector<Vec3<double>> displacement;  ///< m
  std::vector<double> deviation;           ///< one standard deviation of its component across the wall [m]
  double seen = 0;                         ///< share of the area for which the end of the lumen was found
  double residual = 0;                     ///< root mean square distance that is left [m]
};

/// Minimises
///   int w (n . u - d)^2 + l^4 |Lap u|^2 + e |u|^2 dA
/// over displacements u that are linear on the triangles: d is the distance along the normal n to where the lumen ends,
/// w Huber's weight of what is left of it, l the smoothing length or half the radius nearby where that is less, Lap the
/// surface Laplacian with cotangent weights and lumped mass, and e so small that it decides only what nothing else
/// does: motion along the wall is not seen in images of its surface. Rigid motion is not damped, as it would be by
/// |grad u|^2. Repeated with the moved surface and its normals until it rests, and then once more with Lap (u - u1) in
/// place of Lap u, u1 being what was found: what the first pass takes of a motion, (l / R)^4 of an even widening of a
/// tube, is taken of a remainder in the second one (twicing: Tukey 1977, Exploratory data analysis).
///
/// The deviation is that of this smoother, whose kernel is 2 K - K^2 with K = 1 / (1 + l^4 k^4), for residuals which
/// hang together over the grain g of the boundary: 1.28 s g / (4 l), s being their root mean square nearby.
class WallTracker {
 public:
  WallTracker(WallSurface wall, const MotionSettings& settings);
  ~WallTracker();
  WallTracker(WallTracker&&) noexcept;

  const WallSurface& wall() const { return wall_; }
  /// Starts from a displacement of the points; empty: from rest. Throws SolverError when the linear system is not
  /// solved.
  WallMotion track(const LumenBoundary& boundary, const std::vector<Vec3<double>>& start) const;

 private:
  struct Smoother;
  WallSurface wall_;
  MotionSettings settings_;
  std::unique_ptr<Smoother> smoother_;
};

/// Motion from one phase to another: what the images of both have in common, such as the steps of voxels, drops out.
WallMotion difference(const WallMotion& motion, const WallMotion& reference);

}  // namespace tunica::motion_imaging
