// Slices of a segmentation that someone forgot.
#pragma once

#include "tunica/imaging/lumen_mask.hpp"

namespace tunica::imaging {

/// Looks along each axis for up to three slices in which a vessel is missing that the slices before and behind have.
/// They are filled by interpolation where `repair` says so (the log gets which); else InputError with number and place
/// of each.
void mend_slices(LumenMask& mask, bool repair, const Log& log);

}  // namespace tunica::imaging
