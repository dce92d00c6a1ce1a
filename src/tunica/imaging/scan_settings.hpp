// How an idealised dissection is imaged and segmented.
#pragma once

#include <cstdint>

#include "tunica/config/schema.hpp"

namespace tunica::imaging {

struct ScanSettings {
  double voxel = 0.7e-3;  ///< m
  double blur = 0.8e-3;   ///< full width at half maximum of the point-spread function [m]
  double noise = 0.1;     ///< standard deviation, as a share of the contrast of blood and wall
  double tilt = 0;        ///< of the image axes about (1, 1, 1) [rad]
  std::int64_t seed = 1;

  static void add_to(config::Schema<ScanSettings>& schema);
};

}  // namespace tunica::imaging
