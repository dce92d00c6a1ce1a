// Triangles from STL, PLY and OBJ files, read by the few lines that these formats take: what a damaged file claims is
// held against what it has, and errors name the line.
#pragma once

#include <string>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

/// `content` of a file, `where` its name for messages. Coordinates in the unit of the file; points at the same place
/// are merged in STL files, which repeat them. Every corner is a point that exists. Throws InputError for files that
/// are cut off, hold something else than their head says, or name points that do not exist, and for polygons with other
/// than three corners.
TriangleSurface read_stl(const std::string& content, const std::string& where);
TriangleSurface read_ply(const std::string& content, const std::string& where);
TriangleSurface read_obj(const std::string& content, const std::string& where);

/// The InputError for `others` of `cells` polygons that are no triangles.
[[noreturn]] void refuse_polygons(const std::string& where, std::int64_t others, std::int64_t cells);

}  // namespace tunica::geometry
