// Planes through a vessel, by which it is looked at and cut.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::stages {

struct VesselPlane {
  Vec3<double> centre, normal;  ///< in the unit of the places, unit vector
};

/// The plane in which a curved vessel lies: through the middle of its stations, normal to the direction in which they
/// are spread least. None for fewer than three stations.
std::optional<VesselPlane> plane_of(const std::vector<Vec3<double>>& stations);

/// Along the vessel at a station, downstream: from its neighbours. `stations`: at least two.
Vec3<double> direction_at(const std::vector<Vec3<double>>& stations, std::size_t station);

}  // namespace tunica::stages
