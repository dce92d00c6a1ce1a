// The unit cube of `tunica verify`: finite elements through the whole solver.
#pragma once

#include <string>
#include <vector>

#include "tunica/coupling/settings.hpp"
#include "tunica/mesh/mesh_data.hpp"
#include "tunica/stages/material/verify_reference.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

/// A cube with edges of 1 mm, 32 tetrahedra: the 16 rectangles that a box of 2 x 2 x 1 cells has on its surface are cut
/// in two, and each triangle is joined to the node in the middle. Apart from that one all nodes are at the bottom or
/// the top (z_min, z_max).
mesh::MeshData cube_of_32();

struct CubeSolution {
  std::vector<double> stresses;  ///< Cauchy stress [Pa] for each load: sigma_33 or sigma_13, mean over the elements
  double scatter = 0.0;          ///< largest deviation of one element from the mean, relative to it
  int newton_iterations = 0, linear_iterations = 0;  ///< of all loads
  double largest_residual = 0.0;                     ///< of a load at its end, relative to that at its start
};

/// Static equilibrium at each load, from the one before. Extension: planes of symmetry at x_min, y_min, z_min, the top
/// moved along z, x_max and y_max free. Shear: the bottom held, the top moved along x at its height, the sides free
/// (they have no nodes of their own, so that the deformation is homogeneous). Throws SolverError naming the load. For
/// one rank.
CubeSolution solve_cube(const CubeCase& c, wall::Element element);

}  // namespace tunica::stages
