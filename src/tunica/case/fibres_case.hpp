// The file of `tunica fibres`: the mesh, what its faces are, and how fibres lie in each region.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/case/fibre_settings.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::case_file {

struct FibresCase : FibreSettings {
  std::string title;
  MeshSettings meshes;

  /// Faces of the wall that e3 starts from.
  const std::vector<std::string>& inner_faces() const {
    return meshes.interface ? meshes.interface->wall_faces : inner;
  }
  static config::Schema<FibresCase> schema();
};

/// Throws InputError with all problems. Not collective: call it on one rank, and `parse_fibres_case` on the others.
config::Parsed<FibresCase> read_fibres_case(const std::filesystem::path& file);
/// The same from text that one rank has read; looks at no files.
FibresCase parse_fibres_case(const std::string& yaml, const std::filesystem::path& file);

}  // namespace tunica::case_file
