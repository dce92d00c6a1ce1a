// The size of tears in a surface, which filters make larger than the labels have them.
#pragma once

#include "tunica/imaging/flap.hpp"

namespace tunica::imaging {

/// Gives the tears of a closed surface the areas of the contacts: filters draw back the edges of the flap, by more the
/// rougher the labels are. Space is drawn together about the middle of each tear, by less the farther from it, and not
/// at all beyond some millimetres, with the surface and its `contour` between the voxels in it; so nothing can cross
/// and no tear can close. Lists the areas in the log, and returns those of the surface then [m^2].
std::vector<double> narrow_tears(const FlapSides& sides, const std::vector<Contact>& tears,
                                 geometry::TriangleSurface& surface, std::vector<Point>& contour, const Log& log);

}  // namespace tunica::imaging
