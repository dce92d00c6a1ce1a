// Blurs the values of an image.
#pragma once

#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

/// Convolution with a Gaussian of standard deviation `sigma` > 0 [voxels]; values beyond the image count as 0.
void blur(const ImageFrame& frame, double sigma, std::vector<float>& values);

}  // namespace tunica::imaging
