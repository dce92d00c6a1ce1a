// A whole mesh on one rank, as read from files and before distribution.
//
// Regions do not share nodes: at a fluid-structure interface each side keeps its own node, and `twins` says which wall
// node coincides with which lumen node. Velocity and displacement are one unknown of the pair (the lumen side hosts
// it), pressure is separate on each side.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh {

enum class RegionKind { lumen, wall };

struct RegionData {
  std::string name;
  RegionKind kind;
  std::int64_t first_element, end_element;  ///< range in MeshData::tetrahedra
};

/// Values that come with the elements, such as fibre directions; NaN where a file of several has none.
struct ElementField {
  std::string name;
  int components;
  std::vector<double> values;  ///< [element][component]
};

/// One value for each node, such as the stiffness of what surrounds a face; NaN where there is none.
struct NodeField {
  std::string name;
  std::vector<double> values;
};

/// Name of the node field that holds a point array of a face: nodes on the rim of two faces have two values.
inline std::string face_array_name(const std::string& face, const std::string& array) { return face + "." + array; }

struct FaceData {
  std::string name;
  std::int32_t region;                                 ///< index of a region it bounds; other regions are of its kind
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< corners, seen from outside the region counter-clockwise
  std::vector<std::array<std::int64_t, 3>> edges{};    ///< of each triangle: nodes on its edges 01 12 20; see MeshData
};

struct MeshData {
  std::vector<Vec3<double>> points;                     ///< m
  std::vector<std::array<std::int64_t, 4>> tetrahedra;  ///< corners, positive orientation
  std::vector<RegionData> regions;                      ///< at most one lumen, any number of wall regions
  std::vector<FaceData> faces;
  std::vector<ElementField> fields;                          ///< of all tetrahedra
  std::vector<NodeField> node_fields;                        ///< of all points
  std::vector<std::pair<std::int64_t, std::int64_t>> twins;  ///< (wall node, lumen node hosting its motion)
  /// Of each tetrahedron: nodes in the middle of its edges (fe::edge_ends). Empty for linear elements;
  /// edge_nodes.hpp makes them.
  std::vector<std::array<std::int64_t, 6>> edges{};
};

}  // namespace tunica::mesh
