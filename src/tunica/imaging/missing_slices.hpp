// Slices of a segmentation that someone forgot.
#pragma once

#include "tunica/imaging/lumen_mask.hpp"

namespace tunica::imaging {

/// Looks along each axis for up to three slices in which a vessel is missing that the slices before and behind have.
/// They are filled by interpolation where `repair` says so (the log gets which); else InputError with number and place
/// of each. Where both lumens have `one_label`, a flap along the slices looks the same: then only slices count that
/// lack most of the lumen.
void mend_slices(LumenMask& mask, bool one_label, bool repair, const Log& log);

}  // namespace tunica::imaging
