// Writes what a VTK XML writer makes. For .cpp files only that use VTK anyway: VTK's classes are left incomplete here.
#pragma once

#include <filesystem>

class vtkXMLWriter;

namespace tunica::mesh_io {

/// Lets `writer`, which has its input and modes but no name of a file, make the text and writes it as an AtomicFile:
/// VTK itself reports success for files that a full disk has cut off. Throws SolverError with file and cause.
void write_vtk(vtkXMLWriter& writer, const std::filesystem::path& path);

}  // namespace tunica::mesh_io
