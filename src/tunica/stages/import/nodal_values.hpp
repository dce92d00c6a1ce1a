// Values node by node of a face of a peer's case, as a table of points.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::stages {

/// Name of the face of boundary that no face of the peer's file names, in a mesh that is read for its tables.
inline constexpr const char* unnamed_boundary = "boundary without a name";

/// Values of the nodes of a face [SI].
struct NodalTable {
  std::vector<std::int32_t> nodes;                ///< of the face; of a course the first one alone
  std::vector<double> times;                      ///< s; none: the same at all times
  std::vector<std::vector<Vec3<double>>> values;  ///< [time][node], one of them without times
  std::optional<double> period;                   ///< s
};

/// The values of `wanted`, whose numbers are those of `units`, on the nodes of its face of `mesh` [m], one mesh of
/// blood or wall; a unit of the coordinates of mesh files has `metres`. Factors stand in the first components.
/// Throws InputError with file and line where the file does not read, names nodes that are not on the face, or lacks
/// some of these, and where times do not increase from 0. Not collective.
NodalTable read_nodal_values(const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh, double metres,
                             const peer_cases::UnitSystem& units);

/// Writes it for the key `profile.table` or `over_face.table`; where the mesh is of ten-node tetrahedra with the means
/// of the ends on the edges. Throws SolverError when `target` cannot be written.
void write_nodal_table(const NodalTable& table, const peer_cases::NodalValues& wanted, const mesh::MeshData& mesh,
                       bool ten_node, const std::filesystem::path& target);

}  // namespace tunica::stages
