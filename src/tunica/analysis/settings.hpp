// The section `post` of a case file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/frames/settings.hpp"

namespace tunica::analysis {

struct PostSettings {
  std::optional<double> period;                 ///< of the heart beat [s]
  std::optional<double> from, until;            ///< the window, instead of the last period [s]
  std::optional<std::string> inlet;             ///< face where the blood enters the aorta; else see inlet_name()
  std::optional<std::string> end;               ///< face where the aorta ends; else the opening farthest from the inlet
  double spacing = 5e-3;                        ///< of stations along the centreline [m]
  std::vector<double> percentiles;              ///< of stresses [%]
  std::optional<frames::LumenWalls> lumens;     ///< else regions of the usual names, where there are any
  std::string flap = "flap";                    ///< region of the wall
  std::optional<std::filesystem::path> output;  ///< else the folder `post` in that of the results

  static config::Schema<PostSettings> schema();
};

}  // namespace tunica::analysis
