// Takes the noise of voxels from a surface.
#pragma once

#include "tunica/stages/meshing/triangle_surface.hpp"

namespace tunica::stages::imaging {

/// Taubin's filter (SIGGRAPH 1995; eq. (66) of docs/theory.md) on a closed surface: `sweeps` times each point moves
/// towards the middle of its neighbours and then away from it. What is longer than about 4 mm at edges of 0.5 mm stays,
/// volume included.
void smooth_surface(meshing::TriangleSurface& surface, int sweeps);

}  // namespace tunica::stages::imaging
