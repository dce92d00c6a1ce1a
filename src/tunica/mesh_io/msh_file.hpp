// The content of a Gmsh MSH 4.1 file, as far as meshes of linear tetrahedra need it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh_io {

struct MshFile {
  using Key = std::pair<int, int>;  ///< dimension and tag
  template <std::size_t N>
  struct Element {
    std::array<std::int64_t, N> nodes;  ///< positions in `points`
    int entity;                         ///< tag of the elementary surface or volume
  };

  std::map<Key, std::string> physical_names;
  std::map<Key, std::vector<int>> physical_tags;  ///< physical groups of each elementary entity, without their sign
  std::vector<Vec3<double>> points;               ///< in the unit of the file
  std::vector<Element<3>> triangles;
  std::vector<Element<4>> tetrahedra;
  std::vector<mesh::ElementField> fields;  ///< the $ElementData asked for, on `tetrahedra`; NaN where there are none
};

/// Reads an ASCII or binary file of either byte order, as the Gmsh reference manual describes the format ("MSH file
/// format"), its sections in any order. Points and lines are skipped. Throws InputError when the file is missing, of
/// another version, damaged, partitioned, counts more than it has room for, has a section twice or surface or volume
/// elements that are not linear triangles or tetrahedra, or when one of `fields` is absent.
MshFile read_msh(const std::filesystem::path& path, const std::vector<std::string>& fields = {});

}  // namespace tunica::mesh_io
