// The voxels of a labelled image that hold blood, cleaned.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tunica/imaging/label_image.hpp"

namespace tunica::imaging {

enum class Kind : std::uint8_t { tissue, true_lumen, false_lumen };

/// Box around the lumen, with tissue for some voxels around it.
struct LumenMask {
  ImageFrame frame;
  std::vector<Kind> kinds;      ///< x fastest
  Size3 image_low, image_high;  ///< first and last voxel of the whole image, in voxels of this box
  bool is_lumen(std::int64_t index) const { return kinds[index] != Kind::tissue; }
  bool at_image_border(std::int64_t index) const {
    const auto v = frame.voxel(index);
    for (int d = 0; d < 3; ++d)
      if (v[d] == image_low[d] || v[d] == image_high[d]) return true;
    return false;
  }
};

/// The numbers of the lumens in the image.
struct LumenLabels {
  int true_lumen = 1;
  std::optional<int> false_lumen;  ///< none: there is no dissection
};

using Log = std::function<void(const std::string&)>;

/// The lumen of an image: its largest connected piece, holes filled, with `margin` voxels of tissue around it. The log
/// gets what was dropped and filled. InputError for labels that are not in the image, and for lumens that touch
/// nowhere.
LumenMask lumen_mask(const LabelImage& image, const LumenLabels& labels, std::int64_t margin, const Log& log);

/// A place where true and false lumen touch.
struct Contact {
  Point centre;  ///< m
  double area;   ///< seen from straight ahead [m^2]
};
/// Places where true and false lumen touch, largest first; specks of less than `smallest` [m^2] are left out.
std::vector<Contact> find_contacts(const LumenMask& mask, double smallest);

}  // namespace tunica::imaging
