// Looks through a VTK XML file before VTK reads it: VTK allocates what a file claims to hold, and divides by block
// sizes as they stand there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::mesh_io {

/// `kind`: UnstructuredGrid or PolyData. `wanted`: point and cell arrays that will be read; others are not looked at.
/// Throws InputError, with the line, for a file that is missing, empty, of another kind, cut off or without one of the
/// arrays of its geometry, for numbers of points, cells, bytes and blocks that the file has no room for, and for
/// polyhedra and several time steps.
void check_vtk_file(const std::filesystem::path& path, const std::string& kind, const std::vector<std::string>& wanted);

}  // namespace tunica::mesh_io
