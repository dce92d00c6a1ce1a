// The idealised dissection as a scanner and a segmentation would show it: a labelled image with a known truth.
#pragma once

#include <cstdint>
#include <string>

#include "tunica/geometry/dissection_model.hpp"
#include "tunica/imaging/label_image.hpp"
#include "tunica/imaging/scan_settings.hpp"

namespace tunica::imaging {

inline constexpr std::int16_t scan_true_lumen = 1, scan_false_lumen = 2;

/// Partial volume of each voxel, blurred, with noise, cut at half the contrast. True lumen 1, false lumen 2.
LabelImage scan(const geometry::DissectionModel& model, const ScanSettings& settings);

}  // namespace tunica::imaging
