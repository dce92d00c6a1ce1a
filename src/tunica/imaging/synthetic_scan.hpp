// The idealised dissection as a scanner and a segmentation would show it: a labelled image with a known truth.
#pragma once

#include <cstdint>
#include <string>

#include "tunica/config/schema.hpp"
#include "tunica/geometry/dissection_model.hpp"
#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

struct ScanSettings {
  double voxel = 0.7e-3;  ///< m
  double blur = 0.8e-3;   ///< full width at half maximum of the point-spread function [m]
  double noise = 0.1;     ///< standard deviation, as a share of the contrast of blood and wall
  double tilt = 0;        ///< of the image axes about (1, 1, 1) [rad]
  std::int64_t seed = 1;

  static void add_to(config::Schema<ScanSettings>& schema);
};

inline constexpr std::int16_t scan_true_lumen = 1, scan_false_lumen = 2;

/// Partial volume of each voxel, blurred, with noise, cut at half the contrast. True lumen 1, false lumen 2.
LabelImage scan(const geometry::DissectionModel& model, const ScanSettings& settings);

}  // namespace tunica::imaging
