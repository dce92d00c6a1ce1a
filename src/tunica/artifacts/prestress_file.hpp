// The file of a prestress: the wall with S0 or F0 on its elements, for a run and for ParaView.
#pragma once

#include <filesystem>
#include <span>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::artifacts {

/// Writes the wall `data` (nothing but wall; coordinates in m) with the cell arrays `prestress` [element][6 or 9], in
/// double precision, GlobalElementID, region, and for S0 its invariants in kPa. Throws SolverError when that fails.
void write_prestress(const std::filesystem::path& file, const mesh::MeshData& data, wall::PrestressKind kind,
                     std::span<const double> values);

/// Adds the array of such a file to the fields of `data`, NaN in the lumen. Throws InputError when it cannot be read or
/// belongs to another wall: its elements, by number, must have the same corners, within the share
/// `tolerance` of their shortest edge.
void read_prestress(const std::filesystem::path& file, mesh::MeshData& data, double tolerance = 0.01);

}  // namespace tunica::artifacts
