// The mesh of a case and the openings of its lumen, for stages that look at other data in them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::stages {

/// The section `post` of a case; without one, that of its defaults.
analysis::PostSettings post_settings(const case_file::Case& c);

struct VesselOfCase {
  case_file::Case settings;
  std::string inlet;                  ///< face of the lumen
  std::vector<std::string> openings;  ///< faces of the lumen, the inlet first
  mesh::MeshData mesh;                ///< elements with nodes on edges where the case has quadratic ones

  const mesh::FaceData& face(const std::string& name) const;  ///< one of the openings
};

/// Reads a case and its mesh; of a case that makes its mesh that which the stage `mesh` has left. Files that the case
/// reads besides its mesh need not be there yet. Throws InputError for a case or mesh that does not read, one without a
/// lumen, and a mesh that has yet to be made. Not collective.
VesselOfCase vessel_of_case(const std::filesystem::path& case_file);

/// The same with corners alone, whatever elements the case has.
VesselOfCase vessel_with_corners(const std::filesystem::path& case_file);

}  // namespace tunica::stages
