// Motion of the wall of the lumen carried into everything that is meshed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tunica/mesh/mesh_data.hpp"

namespace tunica::motion_imaging {

/// Displacements of all nodes of a mesh of linear elements from those of some: each other node has the mean of its
/// neighbours along edges. A wall node moves with its twin; nodes without a way to a given one stay. Figures of
/// sections, volumes and thin walls depend on what is given alone. `given`: node and displacement [m]. Returns
/// [node][3]. Throws SolverError when the linear system is not solved.
std::vector<double> extended(const mesh::MeshData& data,
                             const std::vector<std::pair<std::int64_t, Vec3<double>>>& given);

}  // namespace tunica::motion_imaging
