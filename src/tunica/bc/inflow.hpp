// Velocity profiles for a prescribed flow through an opening of any shape (docs/theory.md, section 4, "Inlet").
#pragma once

#include <vector>

#include "tunica/bc/face_shape.hpp"

namespace tunica::bc {

enum class Profile { parabolic, flat };

/// v_A = -Q phi_A n carries the flow Q [m^3/s] *into* the region, n pointing outward.
struct InflowProfile {
  std::vector<double> phi;  ///< 1/m^2, one per node of the face, 0 on the rim
  Vec3<double> normal{};    ///< outward area-weighted unit normal of the face
  FaceShape shape;

  /// Velocity [m/s] of node `a` at inflow `q` [m^3/s].
  Vec3<double> velocity(std::size_t a, double q) const { return (-q * phi[a]) * normal; }
};

/// `parabolic`: -Laplace(phi) = 1 on the surface, phi = 0 on the rim, by linear elements; it is the paraboloid on a
/// circle and on an ellipse and the fully developed profile of any other opening. `flat`: constant, 0 on the rim, since
/// rim nodes belong to the wall.
/// Scaled so that the discrete flow is exact: sum over triangles of (mean of phi) n . a_T = 1, a_T the area vectors. On
/// a plane this is the integral of phi; on a face that is not quite planar it is what keeps Q exact.
/// Refers to the positions it is given (the reference mesh): where an opening moves, `coupling` scales the velocities.
/// Planes of symmetry (`symmetry`) are no rim: the profile meets them without a slope, and n must lie in them.
/// Throws InputError: no rim, several separate patches, no node off the rim, zero-area triangle, not a manifold.
InflowProfile inflow_profile(const FaceMesh& face, Profile profile, const SymmetryMarks& symmetry = {});

}  // namespace tunica::bc
