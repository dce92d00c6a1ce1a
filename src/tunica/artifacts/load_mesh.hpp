// From the mesh section of a case to a mesh that a problem can be posed on.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tunica/bc/check.hpp"
#include "tunica/case/case.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/geometry/elements_across.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::artifacts {

/// A mesh as it was read or generated, and what there is to say about it.
struct CheckedMesh {
  mesh::MeshData data;
  std::vector<std::string> report;    ///< what the readers noticed, sizes and quality of the regions; for the log
  std::vector<std::string> warnings;  ///< elements of poor shape, too few across the lumen
  bool ten_node = false;              ///< had one of the files ten-node tetrahedra?
  std::vector<geometry::AcrossPart> across{};  ///< of a case with flow: elements across the parts of its lumen
};

/// Reads or generates the meshes of the case, joins them, adds the prestress that the wall has, checks the shapes of
/// the elements and that every face has exactly one condition; with the nodes on edges where the case has quadratic
/// elements. Throws InputError with all problems that were found. Not collective: for one rank.
CheckedMesh load_mesh(const case_file::Case& c);

/// The same without the nodes on edges: what programs with linear elements know of the mesh.
CheckedMesh load_corner_mesh(const case_file::Case& c);

/// The named faces of a mesh.
std::vector<bc::BoundaryFace> faces_of(const mesh::MeshData& data);
/// Names of the regions of the wall.
std::vector<std::string> wall_regions(const mesh::MeshData& data);

/// All that is wrong with the conditions of a case on faces that are known. Patterns such as `wall_*` are looked up.
std::vector<Problem> check_faces(const case_file::Case& c, const std::vector<bc::BoundaryFace>& faces);

/// Puts the faces of the mesh in the place of patterns among the names of `c.boundary`: `wall_*` stands for every face
/// whose name begins like that, is not named itself and is no interface. `mesh`: significant on rank 0, where
/// load_mesh() has checked them. Collective.
void name_faces(case_file::Case& c, const CheckedMesh& mesh, MPI_Comm comm);

/// Only the meshes of a case, without conditions on their faces. `fields`: element values of the wall that are kept.
CheckedMesh load_meshes(const case_file::MeshSettings& meshes, const std::vector<std::string>& fields);

/// The section `meshes` of a case in a folder where `lumen` and `wall` are meshes in SimVascular's layout, in mm.
/// `wall_regions`: names of the values 1, 2, ... of the cell array `region`; no interface: a wall alone.
std::string meshes_section(const std::vector<std::string>& wall_regions,
                           const std::optional<case_file::InterfaceSettings>& interface);

/// Number that changes with any coordinate, element, face, field or twin: two runs with the same number have the same
/// mesh. Prestress is no part of it.
std::uint64_t mesh_hash(const mesh::MeshData& data);

}  // namespace tunica::artifacts
