// The outside of a wall that is grown from the lumen surface alone.
//
// It is an iso-surface of the distance to the lumen less the local thickness, so it cannot cross itself where branches
// leave, and what lies between two lumens closer than their walls is solid: the flap.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/geometry/openings.hpp"
#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::meshing {

/// Wall thickness that was measured or painted: an array at the points of a surface that lies on the lumen.
struct ThicknessField {
  std::filesystem::path file;  ///< .vtp
  std::string array;
  double metres_per_unit = 0;   ///< of the coordinates
  double metres_per_value = 0;  ///< of the values
  double reach = 2e-3;          ///< how far from the lumen that surface may lie [m]

  static config::Schema<ThicknessField> schema();
};

/// Reads a field and looks at its values, before any work. Throws InputError as take_thickness.
void check_thickness(const ThicknessField& field);

/// Puts the values of a field in the place of `thickness` at the points that have one: those within its reach of a
/// triangle whose values are all numbers. Returns their number. Throws InputError for a file that does not read, has no
/// such array or a value that no wall has, and where no point has one.
std::size_t take_thickness(const ThicknessField& field, const std::vector<geometry::Point>& points,
                           std::vector<double>& thickness);

/// The thickness is proportional to the radius of the vessel between two bounds; equal bounds give a uniform wall.
struct GrowthSettings {
  double per_radius = 0.17;  ///< thickness over the radius of the vessel
  double thinnest = 1.2e-3;  ///< [m]
  double thickest = 2e-3;    ///< [m]
  double fillet = 1e-3;      ///< radius by which notches between vessels are rounded [m], > 0
  double spacing = 0.6e-3;   ///< of the distance samples [m]; below the thickness
  /// Instead of that rule, in these regions of the wall [m].
  std::optional<double> true_lumen_wall, false_lumen_wall, branches;
  /// Instead of both, where it was measured or painted.
  std::optional<ThicknessField> thickness;

  static config::Schema<GrowthSettings> schema();
};

/// Wall thickness [m] at each point of a lumen surface; arguments as of `grow_wall`. The radius of a vessel is that of
/// the largest ball inside a first, uniform wall, so that a dissected aorta counts as one vessel.
std::vector<double> thickness_by_radius(const geometry::TriangleSurface& lumen,
                                        const std::vector<geometry::Opening>& openings, const GrowthSettings& settings);

/// Outer surface [m] around a mended lumen surface with rims in the planes of `openings` (`flatten_rims`), open in the
/// same planes, with outward normals. `thickness` [m]: one for each lumen point. Cavities inside the wall are filled
/// and notches rounded. SolverError when the wall at an opening runs into another vessel.
geometry::TriangleSurface grow_wall(const geometry::TriangleSurface& lumen, const std::vector<double>& thickness,
                                    const std::vector<geometry::Opening>& openings, const GrowthSettings& settings);

}  // namespace tunica::meshing
