// Conditions on the faces that they are given for: as unusual as values alone may be.
#pragma once

#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::artifacts {

/// Warnings: a flow that is unusually fast or slow in its opening, point arrays of supports beyond what typed values
/// are warned of. Limits and reasons are in docs/inputs.md. Reads the tables of flows.
std::vector<Problem> implausible_on_faces(const case_file::Case& c, const mesh::MeshData& data);

}  // namespace tunica::artifacts
