// Makes a surface from a file sound: a manifold with outward normals that does not cross itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/geometry/surface_file.hpp"
#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

struct MendOptions {
  std::string name = "surface";  ///< for messages
  int parts = 1;  ///< connected parts expected; smaller fragments than a hundredth of the area are dropped
  double smallest_opening = 1e-3;  ///< [m] open edges no longer than this times pi are holes, not vessel ends
  std::filesystem::path spots{};   ///< .vtp file for the places of all problems; empty: none is written
};

struct MendedSurface {
  TriangleSurface surface;          ///< normals outward
  std::vector<std::string> report;  ///< what was mended, one line each, and what the surface is like
  std::int64_t openings = 0;
  std::int64_t genus = 0;    ///< sum over the parts, with discs in the openings
  std::int64_t slivers = 0;  ///< triangles with an angle below one degree, left to the remeshing
};

/// Merges coinciding points, drops degenerate and double triangles and small fragments, fills small holes, turns
/// triangles the same way and outward, and reports each of these.
/// InputError with places in mm for what cannot be mended: points that are not finite, edges of more than two
/// triangles, points where the surface only touches itself, one-sided surfaces, too many parts, crossing triangles.
MendedSurface mend_surface(TriangleSurface surface, const MendOptions& options);

/// Checks that the lumen lies inside the outer surface and at least `clearance` [m] away from it. Both mended.
/// InputError with places of crossing triangles, of lumen points outside, and of points that are too near.
void check_nesting(const TriangleSurface& lumen, const TriangleSurface& outer, double clearance,
                   const std::filesystem::path& spots);

}  // namespace tunica::geometry
