// The boundary of a tetrahedral mesh, and the check that named faces cover it exactly once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// Triangles of tetrahedron (0, 1, 2, 3); number f lies opposite node f. Counter-clockwise from outside when the
/// tetrahedron is positive.
inline constexpr int tetrahedron_faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// The same for a triangle in whichever order its nodes are given.
inline std::array<std::int64_t, 3> sorted(std::array<std::int64_t, 3> triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

/// Triangles that belong to exactly one tetrahedron, found in time linear in the number of elements.
class Boundary {
 public:
  struct Triangle {
    std::array<std::int64_t, 3> nodes;  ///< in the outward order of the parent element
    std::int64_t element;               ///< the parent
  };

  /// `nodes`: number of nodes that `tetrahedra` refer to. Throws InputError where more than two tetrahedra share a
  /// triangle, or where two do that lie on the same side of it; `where` names the mesh in that message.
  Boundary(std::span<const std::array<std::int64_t, 4>> tetrahedra, std::int64_t nodes, const std::string& where);

  /// Sorted by their smallest node.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Position in triangles() of the boundary triangle with these nodes in any order, -1 if there is none.
  std::int64_t find(const std::array<std::int64_t, 3>& nodes) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::int64_t> first_;  ///< first triangle by smallest node, one past the end for the last
};

/// Turns every triangle of `data.faces` to outward order and checks that each boundary triangle of the mesh lies in
/// exactly one face. Throws InputError with numbers and places otherwise; `where` names the mesh in the messages.
void orient_and_check_faces(MeshData& data, const Boundary& boundary, const std::string& where);

/// "(x, y, z) m" of the first few `places` and how many more there are.
std::string list_places(std::span<const Vec3<double>> places);

/// The names, separated by commas.
std::string list_names(std::span<const std::string> names);

/// Centroid of a triangle or tetrahedron [m].
template <std::size_t N>
Vec3<double> centroid(const std::vector<Vec3<double>>& points, const std::array<std::int64_t, N>& nodes) {
  Vec3<double> c{{0, 0, 0}};
  for (const auto node : nodes) c = c + points[node];
  return (1.0 / N) * c;
}

/// Normal of a triangle times its area [m^2].
template <class Node>
Vec3<double> area_vector(const std::vector<Vec3<double>>& points, const std::array<Node, 3>& t) {
  return 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Volume of a tetrahedron [m^3], negative when inverted.
inline double volume(const std::vector<Vec3<double>>& points, const std::array<std::int64_t, 4>& t) {
  const auto& a = points[t[0]];
  return dot(points[t[1]] - a, cross(points[t[2]] - a, points[t[3]] - a)) / 6;
}

}  // namespace tunica::mesh
