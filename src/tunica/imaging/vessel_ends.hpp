// Where the vessels of a segmentation end.
//
// A segmented vessel ends in a flat face where the image ends or someone cut it, and in any other way where a level set
// or a network ended it. The ends of a false lumen between flap and wall are wedges and no openings. Ends are found
// from the way through the lumen: they are where it gets no farther.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tunica/geometry/plane_cut.hpp"
#include "tunica/imaging/smooth_field.hpp"

namespace tunica::imaging {

using geometry::VesselEnd;

struct VesselEnds {
  std::vector<VesselEnd> flat;    ///< where they end
  std::vector<VesselEnd> uneven;  ///< of true lumen that ends rounded, ragged or steeply: where it is still whole
};

/// Ends of the lumen. `field` is that of `mask`. An uneven one is found by going along the vessel to its end until the
/// cross-section becomes smaller.
VesselEnds find_ends(const LumenMask& mask, const SmoothField& field);

/// The flat face in which a vessel ends about a place, in whichever direction: also of a vessel that is shorter than
/// wide, which shows no axis. None where no plane has the lumen on one side alone.
std::optional<VesselEnd> end_near(const SmoothField& field, const Point& place);

/// The end of a vessel that is cut by a plane: `radius` is found from the cross-section about `centre`. None where
/// there is no lumen within two voxels of the centre in the plane, or it is wider than 8 cm.
std::optional<VesselEnd> end_at(const SmoothField& field, const Point& centre, const Vec3<double>& normal);

/// Goes on with the vessel beyond the end, as its mirror image, for `reach` [m] and with tissue after that: smoothing
/// then does not round the end, and the plane cuts an open vessel. The mirror stands one and a half voxels before the
/// end, since scanners blur the rims of what ends.
void continue_beyond(const VesselEnd& end, double reach, LumenMask& mask);

}  // namespace tunica::imaging
