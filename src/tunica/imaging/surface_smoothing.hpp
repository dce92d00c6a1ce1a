// Takes the noise of voxels from a surface.
#pragma once

#include <span>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::imaging {

/// Taubin's filter, eq. (9.3) (Taubin 1995), on a closed surface: `sweeps` times each point moves towards the middle of
/// its neighbours and then away from it. What is longer than some twelve edges stays, and so does the volume.
void smooth_surface(geometry::TriangleSurface& surface, int sweeps);

/// How far a closed surface is from what passes its filter, eq. (9.4), as the standard deviation of normal noise with
/// the same median [m]. Vessels, which are long against their edges, pass; noise of the labels over a few voxels does
/// not.
double roughness(const geometry::TriangleSurface& surface);

/// Takes such noise from a closed surface, eq. (9.4) with longer waves. No point moves by more than `farthest` [m].
void smooth_rough_surface(geometry::TriangleSurface& surface, double farthest);

/// Takes points back towards `before`, where no triangles cross, until none do and walls between two sides of the
/// surface are at least about `gap` [m] thick. Returns how many were moved. Places where the surface at `before` is no
/// better stay as there.
std::int64_t untangle(geometry::TriangleSurface& surface, std::span<const geometry::Point> before, double gap);

}  // namespace tunica::imaging
