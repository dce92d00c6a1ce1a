// Surfaces from and to files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// Reads a .vtp, .stl, .ply or .obj file of triangles; `metres_per_unit` > 0 is the length unit of its coordinates.
/// InputError for a missing or damaged file, another kind of file, cells other than triangles, coordinates that are not
/// finite, and a size that no vessel has in that unit. What the triangles are like is checked by `mend_surface`.
TriangleSurface read_surface(const std::filesystem::path& path, double metres_per_unit);

/// Values at the points or triangles, by the array's name in the file.
struct SurfaceArray {
  std::string name;
  std::vector<double> values;
  int components = 1;  ///< those of a point stand side by side
};

/// Writes a .vtp file in metres. Throws InputError when it cannot be written.
void write_surface(const TriangleSurface& surface, const std::filesystem::path& path,
                   const std::vector<SurfaceArray>& point_arrays = {},
                   const std::vector<SurfaceArray>& triangle_arrays = {}, const std::vector<std::string>& names = {});

/// Writes marked places as a .vtp file of points, in metres, with their kind as a string array.
struct Spot {
  Point place;
  std::string kind;
};
void write_spots(const std::vector<Spot>& spots, const std::filesystem::path& path);

}  // namespace tunica::geometry
