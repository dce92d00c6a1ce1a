#include "tunica/mesh_io/vtk_writer.hpp"

#include <fmt/format.h>
#include <vtkXMLWriter.h>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/mesh_io/vtk_messages.hpp"

namespace tunica::mesh_io {

void write_vtk(vtkXMLWriter& writer, const std::filesystem::path& path) {
  const FirstVtkMessage message(&writer);
  writer.WriteToOutputStringOn();
  if (writer.Write() != 1 || writer.GetErrorCode() != 0 || !message.text().empty())
    throw SolverError(fmt::format("cannot write {}: {}", path.string(),
                                  message.text().empty() ? "VTK cannot make the file" : message.text()));
  files::write_atomically(path, writer.GetOutputString());
}

}  // namespace tunica::mesh_io
