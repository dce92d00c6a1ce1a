// What the openings and places of a vessel are: where blood comes in, where branches end, which lumen is which.
#pragma once

#include <string>
#include <vector>

#include "tunica/meshing/assemble.hpp"

namespace tunica::meshing {

struct VesselRoles {
  std::string inlet;                    ///< name of an opening; empty: the first one
  std::vector<std::string> aorta_ends;  ///< openings besides the inlet where the aorta is cut; others end branches
  std::vector<geometry::Point> true_lumen, false_lumen;  ///< places known to lie there [m]; when empty, the inlet does
};

/// Throws InputError for names that are not among `names`: early, where a table names the openings.
void check_names(const VesselRoles& roles, const std::vector<geometry::NamedPlace>& names);

/// The openings with the inlet first. Throws InputError for names that no opening has.
std::vector<geometry::Opening> with_inlet_first(std::vector<geometry::Opening> openings, const VesselRoles& roles);

/// Wall regions by `find_wall_regions`; the first of `openings` is the inlet.
WallRegions wall_regions(const geometry::Tetrahedra& mesh, const SurfaceFaces& faces,
                         const std::vector<geometry::Opening>& openings, const VesselRoles& roles);

}  // namespace tunica::meshing
