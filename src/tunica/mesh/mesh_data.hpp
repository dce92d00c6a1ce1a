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

struct FaceData {
  std::string name;
  std::int32_t region;                                 ///< index of the region it bounds
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< nodes, seen from outside the region counter-clockwise
};

/// Where a region's nodes and elements stand in the file they came from (for messages and output).
struct MeshData {
  std::vector<Vec3<double>> points;                     ///< m
  std::vector<std::array<std::int64_t, 4>> tetrahedra;  ///< positive orientation
  std::vector<RegionData> regions;                      ///< at most one lumen, any number of wall regions
  std::vector<FaceData> faces;
  std::vector<std::pair<std::int64_t, std::int64_t>> twins;  ///< (wall node, lumen node hosting its motion)
};

}  // namespace tunica::mesh
