// How fibres lie in each region of a wall: the file of `tunica fibres` without its meshes, and the section `fibres` of
// a case.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/frames/settings.hpp"

namespace tunica::case_file {

struct RegionFibres {
  double mean_angle = 0;  ///< of the fibre families, from e1 towards e2 and -e2 [rad]
};

struct FibreSettings {
  std::vector<std::string> inlet;               ///< faces where the longitudinal potential starts
  std::vector<std::string> outer;               ///< faces without flux; all others but inlet and interface are outlets
  std::vector<std::string> inner;               ///< of the wall towards the lumen; given when there is no interface
  double mean_angle = 0;                        ///< rad
  std::map<std::string, RegionFibres> regions;  ///< other angles, by the name of the region
  frames::FrameSettings frames;
  std::optional<frames::LumenWalls> tears;
  std::filesystem::path output;

  static config::Schema<FibreSettings> schema();
};

}  // namespace tunica::case_file
