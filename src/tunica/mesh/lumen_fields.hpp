// Node fields that the mesh of a lumen may bring along, written and read with it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// > 0 in the true lumen: tells the lumens of a dissection apart where no wall does.
inline constexpr const char* lumen_side = "lumen_side";

/// From the inlet along the aorta [m], as analysis::Vessel has it: that of another mesh of the same vessel, so that
/// places on both have the same distance.
inline constexpr const char* distance_along = "distance_along";

inline constexpr std::array<const char*, 2> lumen_fields = {lumen_side, distance_along};

/// Values of the field of this name; null where there is none.
inline const std::vector<double>* values_named(const std::vector<NodeField>& fields, std::string_view name) {
  for (const auto& field : fields)
    if (field.name == name) return &field.values;
  return nullptr;
}

}  // namespace tunica::mesh
