// Slabs for plane flows: meshes of one layer of cells (or several) along z, between the faces side_low and side_high,
// which are planes of symmetry. Structured in blocks, refined by whole numbers.
#pragma once

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// A channel [0, length] x [0, height] with a round cylinder and an elastic flag behind it, the domain of Turek & Hron
/// (2006). Lumen ("lumen": faces inlet, outlet, channel, cylinder, flag_lumen) and flag ("flag": flag_root on the
/// cylinder, flag_wall), whose surfaces have twin nodes; the sides are side_low and side_high, flag_low and flag_high.
/// Cells above the flag's axis are cut as the mirror image of those below: cut in one direction everywhere, they load
/// the flag by themselves.
struct FlagSizes {
  double length = 2.5, height = 0.41;       ///< of the channel [m]
  double x = 0.2, y = 0.2, radius = 0.05;   ///< of the cylinder [m]
  double tip = 0.6, flag_thickness = 0.02;  ///< where the flag ends, and its thickness [m]
  double depth = 0.02;                      ///< of the slab along z [m]
  int refinement = 1;                       ///< cells in each direction of the plane, >= 1
  int layers = 1;                           ///< of cells along z, >= 1
};
/// InputError for a flag that does not fit into the channel, or counts out of range.
MeshData flag_behind_cylinder(const FlagSizes& sizes);

/// A channel behind a step: [0, length] x [-height/2, height/2], entered through the upper half of x = 0 (face inlet);
/// the lower half is the step. Faces inlet, outlet, wall_low (with the step), wall_high, side_low, side_high. The
/// domain of Gartling (1990). Cells are `cells_across` through the height and grow along the channel from x = 0.
struct StepSizes {
  double length = 30, height = 1, depth = 0.1;  ///< [m], > 0
  int cells_across = 16, cells_along = 80;      ///< across: even
};
MeshData backward_step(const StepSizes& sizes);

}  // namespace tunica::mesh
