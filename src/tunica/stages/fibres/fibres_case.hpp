// The file of `tunica fibres`: the mesh, what its faces are, and how fibres lie in each region.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/frames/frames.hpp"
#include "tunica/frames/tears.hpp"
#include "tunica/stages/case.hpp"

namespace tunica::stages::fibres {

struct RegionFibres {
  double mean_angle = 0;  ///< of the fibre families, from e1 towards e2 and -e2 [rad]
};

struct FibresCase {
  std::string title;
  MeshSettings meshes;
  std::vector<std::string> inlet;               ///< faces where the longitudinal potential starts
  std::vector<std::string> outer;               ///< faces without flux; all others but inlet and interface are outlets
  std::vector<std::string> inner;               ///< of the wall towards the lumen; given when there is no interface
  double mean_angle = 0;                        ///< rad
  std::map<std::string, RegionFibres> regions;  ///< other angles, by the name of the region
  frames::FrameSettings frames;
  std::optional<frames::LumenWalls> tears;
  std::filesystem::path output;

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

}  // namespace tunica::stages::fibres
