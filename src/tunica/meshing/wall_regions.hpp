// Which part of the wall is which, found from the mesh alone, so that it works for any dissection.
//
// The flap is wall wetted on both sides by different lumens. Which lumen is which: every lumen node gets a value that
// wants to equal its neighbours' and to be the opposite of the value across a thin wall, with the inlet held at 1.
// Blood that the inlet reaches without crossing a tear keeps a positive value, that behind the tears a negative one,
// since a tear is small against the flap. (Minimum of a signed graph Laplacian: Kunegis et al. 2010, SDM, 559-570.)
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tunica/geometry/tetrahedra.hpp"
#include "tunica/geometry/triangle_surface.hpp"
#include "tunica/meshing/improve.hpp"

namespace tunica::meshing {

enum class WallRegion { true_lumen_wall, false_lumen_wall, flap, branches, thrombus };
inline constexpr std::array<const char*, 5> wall_region_names = {"true_lumen_wall", "false_lumen_wall", "flap",
                                                                 "branches", "thrombus"};

struct WallRegions {
  std::vector<WallRegion> of_element;  ///< for wall elements; true_lumen_wall and meaningless for others
  std::vector<double> side;            ///< of each lumen node: > 0 true lumen, < 0 false lumen; 0 for other nodes
};

struct WallRegionOptions {
  double thickest_flap = 4e-3;   ///< thicker walls between two lumens are no flap [m]
  double branch_widening = 1.8;  ///< a branch ends where its cross-section has grown by this factor
  std::vector<geometry::Point> true_lumen{},
      false_lumen{};  ///< places known to lie there [m]; the inlet counts only without
};

/// Cap triangles of one opening, as they are in surface_triangles().
struct Cap {
  std::vector<std::array<geometry::Index, 3>> triangles;
  bool branch;  ///< does the vessel that ends here leave the aorta as a branch?
};

/// `caps`: lumen caps, the inlet first. Throws InputError when the inlet has no triangle, and for
/// places far from the lumen.
WallRegions find_wall_regions(const geometry::Tetrahedra& mesh, const std::vector<Cap>& caps,
                              const WallRegionOptions& options);

/// Clotted blood, which is meshed as wall.
struct Thrombus {
  /// Of a place in it the distance to where the vessel's own wall begins; of a place in that wall or at its surface to
  /// the lumen it is not positive [m].
  std::function<double(const geometry::Point&)> depth;
  double tolerance = 0;  ///< of that distance [m]
  double smallest = 0;   ///< pieces up to this volume are none [m^3]
};

/// What lies inside `body`, the surface around lumen and thrombus together, open at the vessel ends, of an image with
/// voxels [m] of that size. Beside the lumen alone the two surfaces are the same but for what filters do, so a place
/// has to lie 0.3 voxels deep, and pieces below ten voxels are none.
Thrombus thrombus_within(const geometry::TriangleSurface& body, double voxel);

/// Splits wall elements where thrombus and wall meet, so that hardly any is part of both, and mends the shapes of what
/// comes of it; `project`: of the surfaces of the mesh. Returns the number of nodes that it has added.
geometry::Index part_thrombus(geometry::Tetrahedra& mesh, const Thrombus& thrombus, const Projection& project,
                              const std::function<void(const std::string&)>& tell);

/// Makes the wall elements whose centroids lie in the thrombus part of it, whatever else they were found to be; the wall
/// behind it becomes that of the lumen that the thrombus lies in. Returns its volume [m^3].
double mark_thrombus(const geometry::Tetrahedra& mesh, const Thrombus& thrombus, WallRegions& regions);

}  // namespace tunica::meshing
