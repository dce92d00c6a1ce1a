// Cross-sections of the aorta at equal distances along its centreline.
#pragma once

#include "tunica/analysis/vessel.hpp"

namespace tunica::analysis {

/// Index in data.faces of the opening that is farthest from vessel.inlet, along the mesh of the lumen. Throws
/// InputError when there is no other.
std::size_t farthest_opening(const mesh::MeshData& data, const Vessel& vessel);

/// Makes of vessel.along, a potential that rises from 0 at the inlet, the distance along the centreline [m], which
/// joins the centroids of the sections at which the potential has one value.
void turn_into_distances(const mesh::MeshData& data, Vessel& vessel);

/// Level surfaces of the distance vessel.along, split by vessel.side where there is one. Of each lumen the connected
/// piece in the aorta counts, not those in branches. A false lumen of less than 1 % of the section is none. Throws
/// InputError when the spacing leaves no station.
std::vector<Station> make_stations(const mesh::MeshData& data, const Vessel& vessel, double spacing);

}  // namespace tunica::analysis
