// Small structured meshes for tests, verification and benchmarks. All are extrusions along z of a plane triangulation;
// each prism is split into three tetrahedra by the order of its nodes, so that neighbours always conform.
#pragma once

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// Box [0, lengths] with nx x ny x nz cells of six tetrahedra each (Kuhn's split). One region, named "lumen" or "wall"
/// after its kind; faces x_min, x_max, y_min, y_max, z_min, z_max. All counts >= 1, lengths [m] > 0, else InputError.
MeshData box(int nx, int ny, int nz, const Vec3<double>& lengths, RegionKind kind);

/// A straight round tube along z, from z = 0 (inlet) to z = length (outlet).
struct TubeSizes {
  double radius = 0;           ///< of the lumen [m], > 0
  double length = 0;           ///< [m], > 0
  double wall_thickness = 0;   ///< [m], 0: no wall
  int cells_around = 16;       ///< multiple of 4; also four times the cells along an edge of the square core
  int cells_radial = 2;        ///< between the core and the lumen boundary, >= 1
  int cells_along = 10;        ///< >= 1
  int cells_through_wall = 2;  ///< >= 1, not used without a wall
};

/// Why a tube of so many cells cannot be computed: more unknowns than 32-bit numbers, which those of PETSc are, or a
/// mesh that does not fit into the memory of this machine. Empty when it can. Counts >= 1.
std::string objection_to_counts(const TubeSizes& sizes);

/// Radius at the corners of a regular polygon that has the area of a circle of radius 1.
double polygon_radius(int corners);

/// Lumen ("lumen": faces lumen_inlet, lumen_outlet, lumen_wall) from a butterfly grid, and unless wall_thickness is 0
/// a coaxial wall ("wall": wall_inlet, wall_outlet, wall_inner, wall_outer) whose inner nodes are twins of lumen_wall.
/// The circles are polygons with `cells_around` corners on them. InputError for sizes out of range.
MeshData tube(const TubeSizes& sizes);

enum class Sector { full, quarter };

/// Wall only: inner radius, outer radius, length [m] along z, and the cells in each direction. Faces wall_inner,
/// wall_outer, wall_inlet (z = 0), wall_outlet (z = length); a quarter (x >= 0, y >= 0) also has the planes symmetry_x
/// (x = 0, to be held in x) and symmetry_y (y = 0, to be held in y). InputError for sizes out of range.
struct CylinderSizes {
  double inner = 0, outer = 0, length = 0;
  int cells_radial = 2, cells_around = 16, cells_along = 2;
};
MeshData thick_cylinder(const CylinderSizes& sizes, Sector sector);

}  // namespace tunica::mesh
