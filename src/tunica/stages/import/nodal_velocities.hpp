// Velocities node by node of a face of a peer's case, as a table of points.
#pragma once

#include <filesystem>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/peer_cases/translate.hpp"
#include "tunica/peer_cases/unit_system.hpp"

namespace tunica::stages {

/// Velocities of the nodes of a face [m/s].
struct VelocityTable {
  std::vector<std::int32_t> nodes;                ///< of the face
  std::vector<double> times;                      ///< s; none: the same at all times
  std::vector<std::vector<Vec3<double>>> values;  ///< [time][node], one of them without times
};

/// The velocities of `wanted`, whose numbers are those of `units`, on the nodes of its face of `lumen` [m]; a unit
/// of the coordinates of mesh files has `metres`.
/// Throws InputError with file and line where the file does not read, names nodes that are not on the face, or lacks
/// some of these, and where times do not increase from 0. Not collective.
VelocityTable read_nodal_velocities(const peer_cases::NodalVelocities& wanted, const mesh::MeshData& lumen,
                                    double metres, const peer_cases::UnitSystem& units);

/// Writes it for the key `profile.table`. Throws SolverError when `target` cannot be written.
void write_velocity_table(const VelocityTable& table, const mesh::MeshData& lumen, const std::filesystem::path& target);

}  // namespace tunica::stages
