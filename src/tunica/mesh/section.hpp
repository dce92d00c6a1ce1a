// Plane triangulations that are extruded to meshes of tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh::section {

using Index = std::int64_t;

struct Edges {
  std::string name;
  std::vector<std::array<Index, 2>> edges;  ///< the section lies to the left
};

/// A plane triangulation to be extruded.
struct Section {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<Index, 3>> triangles;  ///< counter-clockwise
  std::vector<Edges> boundary;
};

/// Throws InputError of the generated mesh `where`, and what is wrong with its sizes, unless they are good.
void require_size(bool good, const char* where, const char* what);

/// Adds the quadrilateral a b c d (counter-clockwise), cut from a to c.
void add_cut(Section& s, Index a, Index b, Index c, Index d);

/// The same, cut along the diagonal that satisfies the Delaunay criterion.
void add_quadrilateral(Section& s, Index a, Index b, Index c, Index d);

/// Adds a region made of `section` extruded to `layers` layers. `low` and `high` name the faces at z = 0 and z =
/// length.
void extrude(MeshData& mesh, const Section& section, double length, int layers, const std::string& name,
             RegionKind kind, const std::string& low, const std::string& high);

}  // namespace tunica::mesh::section
