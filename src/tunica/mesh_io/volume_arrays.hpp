// Arrays beside a mesh in SimVascular's layout, in files of their own, as svMultiPhysics reads domains, fibres and
// prestress.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh_io {

struct VolumeArray {
  enum class Of { elements, nodes };
  std::string name;
  Of of = Of::elements;
  int components = 1;
  std::vector<double> values{};  ///< [element or node of the whole mesh][component]
  bool whole_numbers = false;    ///< written as Int32
};

/// Writes the regions of one kind with that array, nodes and elements in the order of write_simvascular(). Throws
/// SolverError when the file cannot be written.
void write_volume_array(const std::filesystem::path& file, const mesh::MeshData& data, mesh::RegionKind kind,
                        double metres_per_unit, const VolumeArray& array);

}  // namespace tunica::mesh_io
