// Cuts off the end of a vessel.
#pragma once

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

struct VesselEnd {
  Point centre;         ///< in the plane of the cut [m]
  Vec3<double> normal;  ///< unit, out of the vessel
  double radius;        ///< the end lies within this distance of the axis [m]
};

/// Removes what lies beyond the plane and hangs together with the surface around the axis there; new points lie in the
/// plane exactly. SolverError when that part reaches out of the cylinder of the end's radius: it is not only an end.
TriangleSurface cut_end(const TriangleSurface& surface, const VesselEnd& end);

}  // namespace tunica::geometry
