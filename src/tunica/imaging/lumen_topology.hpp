// Keeps the surface of the lumens as the labels have it: no handle but those that tears make.
#pragma once

#include "tunica/imaging/flap.hpp"
#include "tunica/imaging/label_surface.hpp"
#include "tunica/imaging/voxel_topology.hpp"

namespace tunica::imaging {

/// Opens rings that a lumen of the labels makes. Rings of vessels are bridges, which are an InputError with their
/// places where they are not to be repaired; short ones are roughness of the labels. Rings of a false lumen, and of a
/// lumen that has one label for both, are as they should be where their narrowest place is a tear by the bounds;
/// returns how many of these there are. Beside a flap that is inserted the false lumen runs out in wedges, whose rings
/// are none.
std::int64_t open_rings(LumenMask& mask, const SurfaceSettings& settings, const Log& log);

/// Raises the field at voxels where the filter has joined what the labels have apart, so that true and false lumen have
/// no handles, and touch in one place for each tear. `sides`: null where both lumens have one label. That, or else the
/// false lumen, keeps `rings` handles. SolverError when the filter has cut off more than a speck of a lumen.
void settle(const FlapSides* sides, const std::vector<Contact>& tears, std::int64_t rings, SmoothField& field,
            const Log& log);

}  // namespace tunica::imaging
