// The idealised dissection as a scanner and a segmentation would show it: a labelled image with a known truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tunica/geometry/dissection_model.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/scan_settings.hpp"

namespace tunica::imaging {

inline constexpr std::int16_t scan_true_lumen = 1, scan_false_lumen = 2, scan_thrombus = 3;

/// The scanner's point-spread function on the values of all voxels.
void blur_as_seen(const ImageFrame& frame, const ScanSettings& settings, std::vector<float>& values);

/// Of each voxel, whether it is taken for lumen (1) or not (0): its share of lumen, blurred and with noise, is at least
/// half.
std::vector<std::uint8_t> seen_as_lumen(const ImageFrame& frame, std::vector<float> shares,
                                        const ScanSettings& settings);

/// Partial volume of each voxel, blurred, with noise, cut at half the contrast. True lumen 1, false lumen 2, clotted
/// blood 3, which a scan shows like wall and a reader tells from it by its place.
LabelImage scan(const geometry::DissectionModel& model, const ScanSettings& settings);

}  // namespace tunica::imaging
