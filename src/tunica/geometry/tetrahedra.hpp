// What the meshing engine makes: one conforming mesh whose elements carry labels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunica/geometry/triangle_surface.hpp"

namespace tunica::geometry {

using Index = std::int64_t;

/// What a point or element belongs to.
inline constexpr int outside_label = 0, lumen_label = 1, wall_label = 2;

struct Tetrahedra {
  std::vector<Point> points;                   ///< m
  std::vector<std::array<Index, 4>> elements;  ///< positive orientation; neighbours share nodes across labels
  std::vector<int> labels;                     ///< of each element, > 0
  std::vector<bool> on_curve;                  ///< nodes on lines where more than two labels meet, which stay in place
};

/// Nodes of a face in the order of mesh::tetrahedron_faces, counter-clockwise from outside.
std::array<Index, 3> face_nodes(const Tetrahedra& mesh, Index element, int face);

/// Triangles between two labels, or a label and the outside (0).
struct LabelledTriangle {
  std::array<Index, 3> nodes;  ///< counter-clockwise seen from outside `element`
  Index element, neighbour;    ///< of the smaller and the larger label; outside is a neighbour of -1
  int label, neighbour_label;  ///< label < neighbour_label, or neighbour_label = 0
};
std::vector<LabelledTriangle> surface_triangles(const Tetrahedra& mesh);

/// The elements across the faces of each element, in the order of mesh::tetrahedron_faces; -1: none.
std::vector<std::array<Index, 4>> neighbours(const Tetrahedra& mesh);

}  // namespace tunica::geometry
