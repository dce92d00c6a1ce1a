// Reads the meshes that SimVascular exports, and writes meshes of that form.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/mesh/loaded_mesh.hpp"

namespace tunica::mesh_io {

/// Regions within one volume, told apart by an integer cell array.
struct NamedRegions {
  std::string array;                 ///< such as ModelRegionID
  std::map<int, std::string> names;  ///< every number that occurs, and its region
};

/// A cell or point array that stands in a file of its own, as SimVascular keeps fibres, domains and supports.
struct OtherFile {
  std::string name;            ///< that it gets
  std::filesystem::path file;  ///< with the cells of the volume in the same order; or a surface with the face's points
  std::string array;           ///< its name there
};

struct SimVascularOptions {
  double metres_per_unit = 0;  ///< length unit of the files, for example 0.01 for cm; > 0
  double tolerance = 1e-3;     ///< for the coordinates of face nodes, as a share of the shortest edge at the node
  std::optional<NamedRegions> regions{};                          ///< else the volume is one region
  std::vector<std::string> fields{};                              ///< cell arrays that are kept with the elements
  std::map<std::string, std::vector<std::string>> face_arrays{};  ///< point arrays of faces that are kept, by face
  std::vector<OtherFile> other_files{};  ///< where arrays of `fields` and `regions` stand, if not in the volume
  std::map<std::string, std::vector<OtherFile>> other_face_files{};  ///< point arrays of faces that are kept, likewise
  bool specimen = false;                                             ///< a solid without blood, which may have any size
};

/// Volume and faces wherever they lie.
struct MeshFiles {
  std::filesystem::path volume;
  std::vector<std::pair<std::string, std::filesystem::path>> faces;  ///< name, file
  std::optional<std::string> rest{};  ///< face of the boundary that no file holds; when all is held, there is none
};

/// Reads a `mesh-complete` folder: `mesh-complete.mesh.vtu` and one named face for each `mesh-surfaces/*.vtp` (other
/// surfaces in the folder are unions of these and not read). Any VTK encoding, Float32 or Float64 points.
///
/// The nodes of a face are taken from GlobalNodeID where those lead to the same coordinates (through the GlobalNodeID
/// of the volume, or as 1-based positions when it has none), otherwise all from the coordinates. GlobalElementID is
/// compared with the elements and reported, nothing depends on it. Triangles are turned outward.
///
/// The point arrays mesh::lumen_fields of a lumen are kept where they are there.
///
/// Returns one region called `name`, or the named ones, which share their nodes; a face that bounds several of them is
/// one face. Faces are called after their files. Throws InputError for missing or
/// unreadable files, cells that are no tetrahedra (of ten-node ones the corners are taken, keep_corners()), coordinates
/// that are not finite, nodes without element, inverted elements, face nodes that the volume does not have, a boundary
/// that the faces do not cover exactly once, cell or point arrays that are absent or not finite, region numbers without
/// a name and names without an element.
mesh::LoadedMesh read_simvascular(const std::filesystem::path& folder, mesh::RegionKind kind, const std::string& name,
                                  const SimVascularOptions& options);

/// The same for files with names and places of their own.
mesh::LoadedMesh read_mesh_files(const MeshFiles& files, mesh::RegionKind kind, const std::string& name,
                                 const SimVascularOptions& options);

/// Writes the regions of one kind as a `mesh-complete` folder that read_simvascular reads back: the volume with
/// GlobalNodeID, GlobalElementID, the cell array `region` (1, 2, ... in the order of `data.regions`) and `data.fields`,
/// of a lumen also the point arrays mesh::lumen_fields where `data` has them, a file for each face, and all faces in
/// one. Files of the same names are replaced, other faces there are removed. Coordinates are divided by
/// `metres_per_unit`. Returns the region names in the order of their numbers. Throws SolverError when a file cannot be
/// written.
std::vector<std::string> write_simvascular(const std::filesystem::path& folder, const mesh::MeshData& data,
                                           mesh::RegionKind kind, double metres_per_unit);

/// The files that read_simvascular() reads in a folder, as far as they are there: the volume, then the faces.
std::vector<std::filesystem::path> simvascular_files(const std::filesystem::path& folder);

}  // namespace tunica::mesh_io
