// Takes the noise of voxels from a surface.
#pragma once

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::imaging {

/// Taubin's filter, eq. (9.3) (Taubin 1995), on a closed surface: `sweeps` times each point moves towards the middle of
/// its neighbours and then away from it. What is longer than some twelve edges stays, and so does the volume.
void smooth_surface(geometry::TriangleSurface& surface, int sweeps);

}  // namespace tunica::imaging
