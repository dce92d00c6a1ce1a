// The lumen or the wall of a mesh as a mesh of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

struct Submesh {
  MeshData data;
  std::vector<std::int64_t> nodes, elements;  ///< their numbers in the whole mesh, ascending
};

/// Regions, faces and fields of one kind, with their nodes on edges; twins are left out. Empty where the mesh has no
/// such region.
Submesh submesh(const MeshData& whole, RegionKind kind);

}  // namespace tunica::mesh
