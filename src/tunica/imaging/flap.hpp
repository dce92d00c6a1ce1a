// The wall between true and false lumen: where the labels have it, where it is open, and how thin it may become.
#pragma once

#include "tunica/config/schema.hpp"
#include "tunica/imaging/smooth_field.hpp"

namespace tunica::imaging {

/// A tear that the labels do not show.
struct GivenTear {
  Point centre{};
  double diameter = 0;  ///< m

  static config::Schema<GivenTear> schema();
};

struct FlapSettings {
  std::optional<double> insert;    ///< least thickness of the flap that is put between lumens that touch [m]
  std::vector<GivenTear> tears{};  ///< where such a flap is open

  static config::Schema<FlapSettings> schema();
};

/// Where two lumens touch, or the narrowest section of a ring.
struct OpenPlace {
  double area = 0;    ///< m^2
  double radius = 0;  ///< of the largest ball around one of its points that holds blood alone [m]
  /// Geometric mean of its area and that of the largest disc in it [m^2]: noise opens slits and crumbs, tears are wide.
  double size() const;
};

/// Which of the places where the lumens touch are tears.
struct TearBounds {
  std::optional<double> smallest{};  ///< smaller contacts are closed [m^2]; none: see `noise_among`
  double most_open = 0.4;            ///< share of the flap that tears may take; with more, the labels have no flap

  /// Area of the smallest tear: 10 mm^2 when not given.
  double at_least() const { return smallest.value_or(10e-6); }
  /// Size above which nothing counts as noise [m^2].
  double largest_noise() const { return 6 * at_least(); }
  /// Size below which these places in voxels of `voxel` [m] are noise [m^2]: 0 where a smallest area is given, or fewer
  /// than five are smaller.
  double noise_among(const std::vector<OpenPlace>& places, double voxel) const;
  bool is_tear(const OpenPlace& place, double noise) const { return place.area >= at_least() && place.size() >= noise; }
};

constexpr std::size_t most_listed = 20;  ///< places that were closed

/// A warning in the log where `closed` places are as large as tears of clean labels.
void warn_of_closed(const std::vector<OpenPlace>& closed, const std::string& what, const TearBounds& bounds,
                    const Log& log);

/// The two sides of the flap in a box that holds the false lumen.
struct FlapSides {
  ImageFrame frame;            ///< of the box
  Size3 low;                   ///< its first voxel, in voxels of the mask
  std::vector<float> side;     ///< half the difference of the distances from both lumens [m]: > 0 at the true one
  std::vector<float> to_tear;  ///< distance from the nearest tear [m]
  double area = 0;             ///< of the surface between lumens that face each other within 5 mm [m^2]
};

/// `open`: voxels of the mask in tears.
FlapSides flap_sides(const LumenMask& mask, const std::vector<std::int64_t>& open);

/// Sorts the contacts by `bounds` and lists them in the log. With `insert`, the given tears are found in their place.
/// InputError where the lumens touch nearly everywhere, and for given tears that are not between the lumens.
std::vector<Contact> find_tears(const LumenMask& mask, const FlapSettings& flap, const TearBounds& bounds,
                                const Log& log);

/// Raises the field where the flap would be thinner than `gap` [m], but for the tears. `slope`: of the field across a
/// plane border [1/m].
void hold_apart(const FlapSides& sides, double gap, double slope, const ImageFrame& frame, SmoothField& field);

/// Width about the tears in which the flap may be thinner [m], for voxels of `voxel` [m].
inline double width_of_rim(double voxel) { return 1.5 * voxel; }

}  // namespace tunica::imaging
