// Where lumen and wall of a mesh meet, moved: elements of the lumen become wall, of the wall lumen or another region.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

struct Reassignment {
  /// All regions of the new mesh, at most one lumen; those without an element are left out.
  std::vector<std::pair<std::string, RegionKind>> regions;
  std::vector<std::int32_t> of_element;  ///< number in `regions` of each element; -1: it is taken away
  std::string lumen_face, wall_face;     ///< that new pieces of the surface between lumen and wall belong to
};

/// Places stay as they are; nodes that lumen and wall now share are there twice, as twins, and those that they share no
/// more once. Where elements of the lumen are taken away, as from a mesh without wall, `lumen_face` closes it. Values
/// of elements and nodes stay with them; a node that is new on one side has those of its twin.
///
/// Linear meshes only. Throws InputError where an element at a face other than those between lumen and wall (at an
/// opening, on the outside of the wall) changes its kind, and where `lumen_face` or `wall_face` is needed and is no
/// face.
MeshData reassign(const MeshData& data, const Reassignment& to);

/// Numbers of the parts of the lumen that hang together across faces, for each of its elements in their order; parts
/// are numbered from 0.
std::vector<int> lumen_parts(const MeshData& data);

}  // namespace tunica::mesh
