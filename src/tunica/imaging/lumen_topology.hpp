// Keeps the surface of the lumens as the labels have it: no handle but those that tears make.
#pragma once

#include "tunica/imaging/flap.hpp"
#include "tunica/imaging/voxel_topology.hpp"

namespace tunica::imaging {

/// Opens rings that a lumen of the labels makes: two vessels that touch. Short ones are roughness of the labels; long
/// ones are bridges, which are an InputError with their places unless `repair`. `dissected`: false where one label has
/// both lumens, so that rings are tears where their narrowest place is at least `smallest_tear` [m^2]; returns how many
/// of these there are.
std::int64_t open_bridges(LumenMask& mask, bool dissected, double smallest_tear, bool repair, const Log& log);

/// Raises the field at voxels where the filter has joined what the labels have apart, so that true and false lumen have
/// no handles, and touch in one place for each tear. `sides`: null without a dissection, `handles` then are left in the
/// lumen. SolverError when the filter has cut off more than a speck of a lumen.
void settle(const FlapSides* sides, const std::vector<Contact>& tears, double smallest_tear, SmoothField& field,
            const Log& log);

}  // namespace tunica::imaging
