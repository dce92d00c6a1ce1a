// Where the lumen ends at one phase of the beat, as seen from places of a mesh: in labels, or on a surface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"
#include "tunica/imaging/label_image.hpp"

namespace tunica::motion_imaging {

using geometry::Point;

/// Which lumen a place of the wall belongs to. At the rim of a tear, where both labels meet, it is `either`.
enum class Side : std::uint8_t { true_lumen, false_lumen, either };

class LumenBoundary {
 public:
  virtual ~LumenBoundary() = default;
  /// Signed distance [m] along the unit vector `out`, which points out of the lumen, from a place to where that lumen
  /// ends; the nearest such place, none within `reach` [m] either way.
  virtual std::optional<double> ahead(const Point& place, const Vec3<double>& out, Side side, double reach) const = 0;
  /// Length over which errors of this boundary hang together [m].
  virtual double grain() const = 0;
};

/// Numbers of the lumens in label images.
struct LumenLabels {
  std::int16_t true_lumen = 1;
  std::optional<std::int16_t> false_lumen{};
};

/// Half-way between lumen and not lumen in the blurred labels; nothing is seen within two voxels of the borders of the
/// image and beyond. Voxels farther than `margin` [m] from the box around `places` are dropped. Throws InputError at
/// `where` when a label has no voxel there.
std::unique_ptr<LumenBoundary> boundary_in_labels(const imaging::LabelImage& image, const LumenLabels& labels,
                                                  std::span<const Point> places, double margin,
                                                  const std::string& where);

/// A surface of the lumens whose triangles are wound in one sense, open or closed at the ends of vessels. `places` lie
/// on the wall, `outward` are unit vectors out of the lumen there: they tell which sense it is.
std::unique_ptr<LumenBoundary> boundary_on_surface(geometry::TriangleSurface surface, std::span<const Point> places,
                                                   std::span<const Vec3<double>> outward);

}  // namespace tunica::motion_imaging
