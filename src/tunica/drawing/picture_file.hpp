// Files of meshes for pictures.
#pragma once

#include <string>

class vtkPointSet;

namespace tunica::drawing {

/// Reads a .hdf, .vtu, .vtp, .pvtu or .pvtp file with all its arrays; the caller owns one reference. Files are checked
/// before VTK reads them, and cells before VTK works on them. Throws InputError: damaged, of another kind, cells of a
/// kind that is not drawn.
vtkPointSet* read_points(const std::string& file);

}  // namespace tunica::drawing
