// The file of a prestress: the wall with S0 or F0 on its elements, for a run and for ParaView. Linear elements have it
// in the cell array `prestress`; quadratic ones at each of their points of quadrature in the cell arrays `prestress 1`
// to `prestress 4`, the k-th nearest to their k-th corner, and in `prestress` the mean of them.
#pragma once

#include <filesystem>
#include <span>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/wall/prestress.hpp"

namespace tunica::artifacts {

/// Writes the wall `data` (nothing but wall; coordinates in m), its prestress `values` [element][point][6 or 9] in
/// double precision, GlobalElementID, region, and for S0 the invariants of `prestress` in kPa. Throws SolverError when
/// that fails.
void write_prestress(const std::filesystem::path& file, const mesh::MeshData& data, wall::PrestressKind kind,
                     std::span<const double> values);

/// Adds the prestress of such a file to the fields of `data` [element][point][component], NaN in the lumen. `points` of
/// an element: 1 of a linear one, 4 of a quadratic one. Throws InputError when it cannot be read, is that of the other
/// elements or of another wall: its elements, by number, must have the same corners, within the share `tolerance` of
/// their shortest edge.
void read_prestress(const std::filesystem::path& file, mesh::MeshData& data, int points, double tolerance = 0.01);

}  // namespace tunica::artifacts
