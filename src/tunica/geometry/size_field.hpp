// How long the edges of a mesh should be: fine where the wall is thin or curved, coarse in the wide lumen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::geometry {

struct SizeSettings {
  double largest = 2e-3;       ///< edge length in the wide lumen [m]
  double smallest = 0.4e-3;    ///< nothing is resolved below this [m]
  double per_thickness = 1.0;  ///< edge length over the local thickness of wall or flap
  double per_radius = 0.4;     ///< edge length over the smaller radius of curvature: 0.4 puts 16 edges around a vessel
  double gradation = 0.3;      ///< largest change of the edge length per distance
  std::optional<double> across{};   ///< elements across the diameter of the lumen; none: the diameter does not count
  double smallest_across = 0.6e-3;  ///< narrower than `across` of these [m], the lumen gets fewer
};

/// Edge length at any point: that of the nearest surface point, growing with the distance from it.
class SizeField {
 public:
  /// `sizes` [m]: one for each point of the surface.
  SizeField(TriangleSurface surface, std::vector<double> sizes, double gradation, double largest);
  double operator()(const Point& x) const;

 private:
  TriangleTree tree_;
  std::vector<double> sizes_;
  double gradation_, largest_;
};

/// Distance through the wall, and what lies on its other side.
struct Thickness {
  std::vector<double> value;       ///< [m] at each point; infinity where nothing is within `reach`
  std::vector<std::uint8_t> flap;  ///< 1: blood on both sides, 0: the outer surface is nearer
};

/// Thickness of the wall at each point of the lumen surface, whose normals point into the wall. The other side is the
/// nearest place that lies in front and faces away: of the lumen itself (a flap) or of the outer surface, if there is
/// one. Not looked for beyond `reach` [m].
Thickness wall_thickness(const TriangleTree& lumen, const TriangleTree* outer, double reach);

struct LumenDiameter {
  std::vector<double> value;         ///< [m] at each point; infinity where there is none
  std::vector<std::int64_t> facing;  ///< triangle of the wall on the other side; -1: none
};

/// Local diameter of the lumen at each point of its surface, whose normals point into the wall: that of the largest
/// ball in the lumen that touches the surface there, as far as walls hold it that face the point within 45 degrees.
/// Where walls meet at a larger angle, their corner is no narrow place. Infinity where no such wall is within `reach`,
/// and at points without a triangle. (Ma, Bae & Choi 2012, Vis. Comput. 28, 7-19, without the faced walls; the local
/// thickness of Hildebrand & Rueegsegger 1997, J. Microsc. 185, 67-75, seen from the surface.)
LumenDiameter lumen_diameter(const TriangleTree& lumen, double reach);

/// Smaller radius of curvature [m] at each point, from normals averaged over neighbours so that noise counts little.
std::vector<double> curvature_radius(const TriangleSurface& surface);

/// Edge length at each point by `settings` from curvature, thickness and the diameter of the lumen, graded along the
/// edges. The last two may be empty.
std::vector<double> surface_sizes(const TriangleSurface& surface, std::span<const double> thickness,
                                  std::span<const double> diameter, const SizeSettings& settings);

/// Edge length in the lumen beside each point of its surface by the diameter alone, for `settings` with `across`.
std::vector<double> lumen_sizes(const TriangleSurface& surface, std::span<const double> diameter,
                                const SizeSettings& settings);

/// Lowers sizes until no two neighbours differ by more than gradation times their distance.
void limit_gradation(const TriangleSurface& surface, double gradation, std::vector<double>& sizes);

}  // namespace tunica::geometry
