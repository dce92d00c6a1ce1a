// Meshes of ten-node tetrahedra and their faces, whose corners alone are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/mesh_io/vtk_files.hpp"

namespace tunica::mesh_io {

/// VTK's cell types.
inline constexpr int vtk_triangle = 5, vtk_tetrahedron = 10, vtk_quadratic_triangle = 22,
                     vtk_quadratic_tetrahedron = 24;

/// What has become of quadratic cells.
struct Straightened {
  bool any = false;               ///< were there quadratic cells?
  std::int64_t bent = 0;          ///< edges whose node is off the middle of its ends
  double farthest = 0.0;          ///< of these nodes, as a share of the edge
  Vec3<double> place{{0, 0, 0}};  ///< of that one, in the unit of the file
};

/// Turns cells that are all ten-node tetrahedra, or all six-node triangles, into those of their corners, and takes the
/// nodes that are no corners out of `cells` and of all that belongs to points. `elements: quadratic` gives every edge
/// a node again, in its middle. Cells of other types, and of several, are left as they are.
Straightened keep_corners(VtkCells& cells);

/// Reads the face of a volume: triangles in a .vtp file, or in a .vtu file as svMultiPhysics keeps the faces of
/// ten-node tetrahedra; six-node triangles become those of their corners. `fields`: point arrays of one component,
/// which have to be there. Throws as read_vtk_surface.
VtkCells read_face_cells(const std::filesystem::path& path, const std::vector<std::string>& fields);

/// A line for the log, or for a warning; empty where no edge is bent.
std::string describe(const Straightened& straightened, const std::string& where);

}  // namespace tunica::mesh_io
