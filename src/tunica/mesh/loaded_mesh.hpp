// What a mesh reader returns: the mesh, and what it noticed on the way.
#pragma once

#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

struct LoadedMesh {
  MeshData data;
  std::vector<std::string> report;         ///< one line per face or decision, for the log
  std::vector<std::string> warnings = {};  ///< what may be a slip
  bool ten_node = false;                   ///< had the file ten-node tetrahedra, of which the corners are kept?
};

}  // namespace tunica::mesh
