// Meshes of several regions from one Gmsh file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/mesh/loaded_mesh.hpp"

namespace tunica::mesh_io {

struct GmshRegion {
  std::string physical_volume;  ///< name of the physical volume, also the name of the region
  mesh::RegionKind kind;
};

struct GmshOptions {
  double metres_per_unit = 0;         ///< length unit of the file, > 0
  std::vector<GmshRegion> regions;    ///< every physical volume of the file; at most one lumen
  std::vector<std::string> fields{};  ///< $ElementData that are kept with the tetrahedra, NaN where there are none
};

/// Reads a MSH 4.1 file whose volumes and boundary surfaces all belong to named physical groups.
///
/// Nodes that lumen and walls share are split: the lumen keeps them, the walls (which go on sharing nodes with each
/// other) get copies, and `twins` pairs them.
///
/// A physical surface becomes a face of the same name when it bounds one region. One that bounds several, as the
/// interface of lumen and wall does, becomes one face for each, called `<region>_<surface>`: the physical surface
/// `interface` between `lumen` and `wall` gives `lumen_interface` and `wall_interface`. An interface that is in no
/// physical surface is named so, too. Surfaces between two walls lie inside the mesh and are left out, which the
/// report says.
///
/// Throws InputError for what read_msh refuses, volumes without or with an undeclared physical name, inverted
/// elements, boundary triangles in no or in two physical surfaces, surfaces that lie inside a region, and element data
/// that are absent.
mesh::LoadedMesh read_gmsh(const std::filesystem::path& path, const GmshOptions& options);

}  // namespace tunica::mesh_io
