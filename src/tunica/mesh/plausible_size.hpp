// Is a mesh as large as a vessel is?
#pragma once

#include <optional>

#include "tunica/base/error.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::mesh {

/// A warning when the mesh is longer than 0.7 m or shorter than 5 mm along all axes, or its lumen holds more than a
/// litre; limits and reasons are in docs/inputs.md. `metres_per_unit`: of the file it came from, for the unit that was
/// likely meant.
std::optional<Problem> implausible_size(const MeshData& data, const std::optional<double>& metres_per_unit);

}  // namespace tunica::mesh
