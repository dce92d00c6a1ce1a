// A prestress that stands at the nodes, as one for each element.
#pragma once

#include <filesystem>

#include "tunica/case/case.hpp"

namespace tunica::stages {

/// Writes `target`, a file as `tunica prestress` makes it, from the point or cell array Stress of `nodal`
/// (second Piola-Kirchhoff, 11 22 33 12 23 13, in units of `pascals`) on the volume of the wall in `meshes`: of nodes,
/// each element gets the mean of its own, which is that of the linear function between them. Throws InputError when a
/// file cannot be read or the points are not those of the wall, SolverError when `target` cannot be written. Not
/// collective.
void write_element_prestress(const std::filesystem::path& nodal, double pascals, case_file::MeshSettings meshes,
                             const std::filesystem::path& target);

}  // namespace tunica::stages
