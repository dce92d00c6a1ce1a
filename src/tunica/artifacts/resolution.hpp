// How many elements the mesh of a case has across its lumen, against what its elements need.
#pragma once

#include <optional>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/geometry/elements_across.hpp"
#include "tunica/mesh/mesh_data.hpp"

namespace tunica::artifacts {

/// Of each opening, called as its face, and of the lumen: `lumen`, or where the wall has several regions the part
/// beside each, as `lumen by <region>`; of each tear, where the wall region of the flap (`post.flap`) faces itself.
/// Walls are the faces of the lumen that blood sticks to, by `c.boundary` without patterns and the interface. Empty
/// without flow, and where planes of symmetry cut the vessel.
std::vector<geometry::AcrossPart> resolution(const case_file::Case& c, const mesh::MeshData& data);

/// A warning where a part has too few for the elements of the case.
std::optional<Problem> too_few_across(const case_file::Case& c, const std::vector<geometry::AcrossPart>& parts);

}  // namespace tunica::artifacts
