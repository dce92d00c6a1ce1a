// What a run has computed, as far as its results are read by it: filled in from a case file by whoever has one.
#pragma once

#include <string>
#include <vector>

namespace tunica::analysis {

struct RunDescription {
  bool fluid = false, wall = false;         ///< which of them have fields
  bool interface = false;                   ///< do lumen and wall share one?
  std::vector<std::string> sticking_faces;  ///< of the lumen, where blood moves with the wall or stands still
  std::vector<std::string> inflow_faces;    ///< those with a flow
  std::string length_unit = "mm";           ///< of the coordinates and displacements in the files

  bool moves() const { return fluid && wall; }
};

}  // namespace tunica::analysis
