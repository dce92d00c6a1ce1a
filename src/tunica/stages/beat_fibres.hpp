// Mean directions of the fibres on the surfaces of the wall, for pages.
#pragma once

#include <vector>

#include "tunica/mesh/mesh_data.hpp"
#include "tunica/viewer/beat.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::stages {

/// Short lines along the mean directions of each family on the outside of the wall and where it meets the blood, about
/// evenly spread; none for laws without families. Of layers those of the innermost. `data` is the mesh with linear
/// elements and the cell arrays of the frame (wall::frame_arrays). Throws InputError where an element has no frame.
std::vector<viewer::Lines> fibre_lines(const wall::Parameters& wall, const mesh::MeshData& data);

}  // namespace tunica::stages
