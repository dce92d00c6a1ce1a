// Looks through a VTK XML file before VTK reads it: VTK allocates what a file claims to hold, and divides by block
// sizes as they stand there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tunica::mesh_io {

/// `kind`: UnstructuredGrid or PolyData. `wanted`: point and cell arrays that will be read; others are not looked at.
/// None: all will be read.
/// Throws InputError, with the line, for a file that is missing, empty, of another kind, cut off or without one of the
/// arrays of its geometry, for numbers of points, cells, bytes and blocks that the file has no room for, and for
/// polyhedra and several time steps.
///
/// Returns the text that VTK is to read instead of the file, empty when it is the file itself: VTK writes beyond the
/// end of texts that are longer than their head says, and they are not needed here.
std::string check_vtk_file(const std::filesystem::path& path, const std::string& kind,
                           const std::optional<std::vector<std::string>>& wanted);

}  // namespace tunica::mesh_io
