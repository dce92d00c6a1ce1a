// What a page shows of a mesh: its boundary, the surface between blood and wall once, and plane cuts.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/viewer/beat.hpp"

namespace tunica::viewer {

/// Names of the faces whose part is not clear from the mesh alone.
struct FaceRoles {
  std::set<std::string> lumen_interface, wall_interface;  ///< where blood and wall meet
  std::set<std::string> sticking;                         ///< of the lumen, at which the blood sticks to a rigid wall
};

/// Where a point of a body takes its values from: (1 - t) * [a] + t * [b], nodes of the mesh.
struct PointSource {
  std::int64_t a = -1, b = -1;
  double t = 0;
};

/// A body without quantities, and how to fill them: points [0, wall_end) have values of the wall, [blood_first,
/// blood_end) of the blood, which stands still at the wall in [blood_first, inside_end).
struct Skeleton {
  Body body;
  std::vector<PointSource> wall;   ///< of the points from 0, wall_end of them
  std::vector<PointSource> blood;  ///< of the points from blood_first
  std::size_t wall_end = 0, blood_first = 0, inside_end = 0, blood_end = 0;
};

/// The region that an element belongs to.
const mesh::RegionData& region_of(const mesh::MeshData& data, std::int64_t element);

/// The boundary of all regions. Groups: "outer" and "inner" by the region of the wall ("lumen" where there is no
/// wall), "end" (rings of the wall) and "opening" by the face. Corners of the elements only: quadratic meshes are
/// given subdivided. Throws InputError as mesh::Boundary.
Skeleton surface_of(const mesh::MeshData& data, const FaceRoles& roles);

/// Of a boundary whose mesh was subdivided: the triangles that there were, in the order of the groups (Body::joined).
/// `corners`: number of nodes before, which come first.
std::vector<Joined> joined_triangles(const Skeleton& surface, std::int64_t corners);

/// A plane through the vessel, within a distance of a place.
struct CutPlane {
  std::string name;
  Vec3<double> centre, normal;  ///< [m], unit
  double radius = 0;            ///< elements farther than this from the centre are left out [m]; 0: none
};

/// Where planes cut the elements: for each plane a group "section" of the blood and a group "wall section".
Skeleton sections_of(const mesh::MeshData& data, const std::vector<CutPlane>& planes);

}  // namespace tunica::viewer
