// Whether what was read can be a vessel, by its size: the slip of a unit is found here, not by the messages of others.
#pragma once

#include <span>
#include <string>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh_io {

/// Throws InputError when the box around the points [m] has a diagonal below 2 mm or above 20 m, naming the length unit
/// `metres_per_unit` and those that would give a likely size. `where` names the file. Coordinates are finite.
void refuse_unlikely_size(std::span<const Vec3<double>> points, double metres_per_unit, const std::string& where);

/// "120 mm x 21 mm x 20.5 mm": the box around the points.
std::string size_text(std::span<const Vec3<double>> points);

}  // namespace tunica::mesh_io
