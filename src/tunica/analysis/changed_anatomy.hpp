// A vessel with a tear closed, a new one, or a sleeve in it: which elements become what.
#pragma once

#include <string>
#include <vector>

#include "tunica/analysis/anatomy.hpp"
#include "tunica/mesh/reassign.hpp"

namespace tunica::analysis {

struct PlannedTear {
  double position = 0, area = 0;  ///< along the aorta [m], of the flap that is taken away [m^2]
};
struct PlannedSleeve {
  double from = 0, to = 0;           ///< along the aorta [m]
  std::vector<std::string> regions;  ///< of the wall that it lines
  std::string name;                  ///< of the region that they become
};

struct AnatomyChange {
  std::vector<std::string> close_tears;  ///< names in `Anatomy::tears`
  std::vector<PlannedTear> open_tears;
  std::vector<PlannedSleeve> sleeves;
  std::string flap = "flap";  ///< region of the wall that closed tears become part of
};

struct ChangedMesh {
  mesh::MeshData data;
  std::vector<std::string> remarks;  ///< what was done, with figures
};

/// Elements of the lumen that reach from one lumen into the other across a tear become flap, those within a sleeve the
/// sleeve; without a wall they are taken away, and `lumen_face` closes the lumen. Elements of the flap nearest to the
/// place of a new tear become lumen, from one side to the other, until they have its area. What such a change leaves of
/// the lumen without an opening is filled, too, up to 1 % of it. `data`: with mesh::lumen_side and
/// mesh::distance_along, which places count by; `lumen_face`, `wall_face`: between lumen and wall. Throws InputError
/// for tears that are not there, lumens that are not told apart, sleeves that hold no wall, places without flap, tears
/// that run into another one, an opening that is reached, and a lumen of which more has no opening left. Not
/// collective.
ChangedMesh change_anatomy(const mesh::MeshData& data, const Anatomy& anatomy, const AnatomyChange& change,
                           const std::string& lumen_face, const std::string& wall_face);

}  // namespace tunica::analysis
