// Node fields that the mesh of a lumen may bring along, written and read with it.
#pragma once

#include <array>

namespace tunica::mesh {

/// > 0 in the true lumen: tells the lumens of a dissection apart where no wall does.
inline constexpr const char* lumen_side = "lumen_side";

/// From the inlet along the aorta [m], as analysis::Vessel has it: that of another mesh of the same vessel, so that
/// places on both have the same distance.
inline constexpr const char* distance_along = "distance_along";

inline constexpr std::array<const char*, 2> lumen_fields = {lumen_side, distance_along};

}  // namespace tunica::mesh
