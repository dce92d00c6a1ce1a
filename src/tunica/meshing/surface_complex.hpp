// What the surface side of meshing produces and the tetrahedral engine fills: a closed, conforming, labelled complex of
// triangles.
//
// Two patches meet only in shared rim points, no two triangles cross, and every patch separates the two labels that it
// names, so that a walk across triangles always knows where it is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::meshing {

enum class Label : std::uint8_t { outside = 0, lumen = 1, wall = 2 };

enum class PatchKind : std::uint8_t { interface, lumen_cap, wall_ring, outer_wall };

struct Patch {
  std::string name;
  PatchKind kind;
  Label negative;  ///< behind the triangles
  Label positive;  ///< on the side that their normals point to
};

/// A line where patches meet: closed, the first point is not repeated.
struct Rim {
  std::string name;
  std::vector<std::int64_t> points;
};

struct SurfaceComplex {
  std::vector<geometry::Point> points;  ///< m
  std::vector<geometry::Triangle> triangles;
  std::vector<std::int32_t> patch_of;  ///< of each triangle: position in `patches`
  std::vector<Patch> patches;
  std::vector<Rim> rims;  ///< the lumen rim and the wall rim of each opening
};

/// Volume [m^3] of a label other than outside.
double volume(const SurfaceComplex& complex, Label label);
/// Area [m^2] of a patch.
double area(const SurfaceComplex& complex, std::int32_t patch);
/// The triangles of all patches of a kind, points renumbered.
geometry::TriangleSurface surface_of(const SurfaceComplex& complex, PatchKind kind);

/// Throws SolverError with places if the labels around an edge do not fit together (a gap, or a wrongly turned patch),
/// or if two triangles cross.
void verify(const SurfaceComplex& complex);

/// Writes a .vtp file in metres with the cell arrays patch, kind, negative_label, positive_label, and the names of the
/// patches as a field array. Throws InputError when the file cannot be written.
void write_complex(const SurfaceComplex& complex, const std::filesystem::path& path);

}  // namespace tunica::meshing
