// Voxels of equal sides, from those that are not.
#pragma once

#include "tunica/imaging/lumen_mask.hpp"

namespace tunica::imaging {

/// The lumens on voxels that are at most a third longer than wide and no larger than 1.2 mm. Between slices the outline
/// of each lumen goes over into that of the next one (shape-based interpolation: the distance from it, within the
/// slices, is interpolated; Raya & Udupa 1990, IEEE Trans. Med. Imaging 9, 32-42). The mask as it is where its voxels
/// are so already.
LumenMask with_even_voxels(LumenMask mask);

/// A label of a place between two slices of the same frame, which have one slice each: `share` 0 is the first of them.
/// `kinds` of the result has one slice.
std::vector<Kind> between_slices(const ImageFrame& slice, const std::vector<Kind>& first,
                                 const std::vector<Kind>& second, int axis, double share);

}  // namespace tunica::imaging
