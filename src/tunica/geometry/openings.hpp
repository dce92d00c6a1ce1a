// Where vessels end: the open edges of lumen and outer surface, in pairs, with names and planes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

struct NamedPlace {
  std::string name;
  Point place;  ///< m
};

struct Opening {
  std::string name;
  Point centre;         ///< of the lumen rim [m]
  Vec3<double> normal;  ///< unit, out of the vessel
  double area = 0;      ///< of the lumen [m^2]
  double reach = 0;     ///< largest distance of a rim point, of lumen or wall, from the centre [m]
  Loop lumen;           ///< points of the lumen surface
  Loop wall;            ///< points of the outer surface; empty if there is none
  double out_of_plane;  ///< largest distance of a rim point from the plane [m]
};

/// Does a node of a mesh lie in the plane of the opening, in lumen or wall? Remeshed rims reach out a little, to keep
/// the area.
bool lies_in(const Opening& opening, const Point& x);

/// Reads names and centres from a CSV file with the columns name, centre_x, centre_y, centre_z. InputError for a
/// missing file or column, a name that is there twice, or a value that is no number.
std::vector<NamedPlace> read_opening_names(const std::filesystem::path& path, double metres_per_unit);

/// Openings of the lumen surface, each with the rim of the outer surface (null: none) around it. A name goes to the
/// opening that is nearest; without names they are called inlet (the largest one), outlet_1, outlet_2, ... by falling
/// area. InputError, with all places, for rims without a counterpart or not around it, rims that are not planar within
/// a fifth of their radius, names without an opening and openings without a name, a surface without openings, and a
/// largest opening that is narrower than 4 mm or wider than 150 mm.
std::vector<Opening> find_openings(const TriangleSurface& lumen, const TriangleSurface* outer,
                                   const std::vector<NamedPlace>& names);

/// Moves the rims into the planes of their openings, and the surface near them along, so that no triangle folds.
void flatten_rims(TriangleSurface& surface, const std::vector<Opening>& openings, Loop Opening::*rim);

}  // namespace tunica::geometry
