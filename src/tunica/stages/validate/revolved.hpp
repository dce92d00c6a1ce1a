// Vessels of revolution as surfaces for `tunica mesh`.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace tunica::stages::validate {

/// A vessel along z: the lumen by its radius at places along z, joined by straight lines, and a tube around it, which
/// `tunica mesh` takes for the outside of the wall.
struct RevolvedVessel {
  std::vector<std::array<double, 2>> profile;  ///< z, radius [m]; z does not fall
  double spacing = 1e-3;                       ///< of points along the profile [m]
  int around = 96;                             ///< points on a circle
  double elements_across = 4;                  ///< asked of the mesher
  double shortest_edge = 0.3e-3;               ///< likewise [m]
};

/// Files for the case: surfaces (.obj, mm), openings.csv and mesh.yaml, whose mesh goes to the folder `mesh`; its
/// openings are called inlet (at the lower end) and outlet. The circles are polygons of their area.
std::vector<std::pair<std::string, std::string>> mesh_files(const RevolvedVessel& vessel);

}  // namespace tunica::stages::validate
