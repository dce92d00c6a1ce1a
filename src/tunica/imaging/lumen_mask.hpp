// The voxels of a labelled image that hold blood, cleaned.
#pragma once

#include <array>
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

/// What the labels of the image mean; 0 is no part of the vessel.
struct LumenLabels {
  int true_lumen = 1;
  std::optional<int> false_lumen;  ///< none: there is no dissection
  std::vector<double> tissue{};    ///< further labels that are no blood
  std::optional<int> thrombus{};   ///< clotted blood within the vessel: no lumen, but the wall goes around it
};

/// Which faults of a segmentation are mended; the others are errors.
enum class Repair : std::uint8_t { slices, pieces, bridges };
struct Repairs {
  std::array<bool, 3> asked{};
  bool operator[](Repair repair) const { return asked[static_cast<std::size_t>(repair)]; }
};

/// Which voxels are of a kind, one entry each.
std::vector<std::uint8_t> voxels_of(const std::vector<Kind>& kinds, Kind kind);

using Log = std::function<void(const std::string&)>;

/// "(x, y, z) mm" of one place.
std::string in_mm(const Point& place);

/// Of these voxels, at least one [m].
Point middle_of(const ImageFrame& frame, const std::vector<std::int64_t>& voxels);

/// The lumen of an image: its largest connected piece, holes filled, with tissue around it for `margin` voxels of their
/// shortest side. The log gets what each label becomes, and what was dropped and filled. `apart`: whether the lumens
/// may be two pieces, with no tear between them. InputError for labels that are not in the image or not known, for
/// slices that are missing and separate pieces above 1 ml where these are not repaired, and for lumens that touch
/// nowhere.
LumenMask lumen_mask(const LabelImage& image, const LumenLabels& labels, std::int64_t margin, const Log& log,
                     const Repairs& repairs = {}, bool apart = false);

/// A place where true and false lumen touch.
struct Contact {
  Point centre;                        ///< m
  double area;                         ///< seen from straight ahead [m^2]
  std::vector<std::int64_t> voxels{};  ///< of the false lumen
  double touching = 0;                 ///< of all faces that touch, whichever way they look [m^2]
};
/// Places where true and false lumen touch, largest first; specks of less than `smallest` [m^2] are left out.
std::vector<Contact> find_contacts(const LumenMask& mask, double smallest);

}  // namespace tunica::imaging
