// What a run has computed, as far as its results are read by it: filled in from a case file by whoever has one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tunica::analysis {

/// Layers of a wall: element values of the depth, and at which depth each layer but the innermost begins.
struct LayerBorders {
  std::string depth;
  std::vector<double> beyond;
};

struct RunDescription {
  bool fluid = false, wall = false;         ///< which of them have fields
  bool interface = false;                   ///< do lumen and wall share one?
  std::vector<std::string> sticking_faces;  ///< of the lumen, where blood moves with the wall or stands still
  std::vector<std::string> inflow_faces;    ///< those with a flow
  std::string length_unit = "mm";           ///< of the coordinates and displacements in the files
  std::map<std::string, std::optional<LayerBorders>> layers_of_region{};  ///< of those with a material of their own
  std::optional<LayerBorders> layers{};                                   ///< of all other regions of the wall

  bool moves() const { return fluid && wall; }
  std::vector<std::string> depths() const;  ///< names of the element values that layers are told by, each once
};

}  // namespace tunica::analysis
