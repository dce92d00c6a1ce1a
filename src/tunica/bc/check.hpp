// Exactly one condition per face and field.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/bc/conditions.hpp"

namespace tunica::bc {

enum class Field { lumen, wall };

/// A face of the mesh and the region that it bounds.
struct BoundaryFace {
  std::string name;
  Field field;
};

struct BoundaryCase {
  std::vector<BoundaryFace> faces;                              ///< all of the mesh
  std::vector<std::pair<std::string, std::string>> interfaces;  ///< (lumen face, wall face), coupled
  std::vector<std::pair<std::string, Condition>> conditions;    ///< as in the case file, in its order
  bool rigid_wall = false;                                      ///< flow alone: nothing compliant takes up volume
  bool static_wall = false;                                     ///< no inertia: an unsupported wall is singular
  bool pressure_point = false;                                  ///< the pressure of one node is given
};

/// All that is wrong, in the order faces then conditions; empty when the case is sound. `where` is boundary.<face>.
/// - unknown face name (with the nearest existing one), two conditions for one face, a face without a condition
/// - a condition on an interface face (the coupling is its condition); interface names that do not exist or are on the
///   wrong side
/// - a condition that does not fit the region
/// - rigid flow where every lumen face prescribes velocity: pressure is undetermined and the flows may not balance
/// - a pressure point where a face or the wall sets the pressure
/// - static wall without a fixed or supporting face, or fixed in too few directions to hold it
std::vector<Problem> check_boundary(const BoundaryCase& boundary);

}  // namespace tunica::bc
