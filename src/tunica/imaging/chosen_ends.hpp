// Which ends of the vessels in a segmentation are opened.
#pragma once

#include "tunica/imaging/label_surface.hpp"

namespace tunica::imaging {

/// The ends that `settings.openings` name, in their order, or all that are found, the flat ones first. The log gets
/// what stays closed, and for each end that is not flat a line for the case file. InputError for openings at which no
/// vessel ends, and for an end that no opening names though it is wider than the inlet.
std::vector<VesselEnd> choose_ends(const LumenMask& mask, const SmoothField& field, const SurfaceSettings& settings,
                                   const Log& log);

/// The end that `settings` name as the inlet, or the first opening, or the widest end.
const VesselEnd& inlet_of(const std::vector<VesselEnd>& ends, const SurfaceSettings& settings);

}  // namespace tunica::imaging
