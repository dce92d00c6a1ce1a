// What stresses of the wall are told for: its regions, and the layers of those that have some.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tunica/analysis/description.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::analysis {

struct WallPart {
  std::string name;                    ///< of the region, or "flap layer 2", the innermost layer being the first one
  std::vector<std::int64_t> elements;  ///< of MeshData
};

/// Each region of the wall, followed by its layers: where layers are blended, an element counts to the one that begins
/// last before its depth. Layers without an element are left out.
std::vector<WallPart> wall_parts(const RunDescription& run, const mesh::MeshData& data);

}  // namespace tunica::analysis
