// Distances in an image, exact between the centres of voxels.
#pragma once

#include <vector>

#include "tunica/imaging/voxel_topology.hpp"

namespace tunica::imaging {

/// Distance of each voxel from the nearest one of the set [m]; infinite where the set is empty. Axes are taken to be
/// perpendicular. (Felzenszwalb & Huttenlocher 2012, Theory Comput. 8, 415-428.)
std::vector<float> distance_to(const ImageFrame& frame, const VoxelSet& set);

/// Distance from the border of the set, which is half a step beyond its last voxels, < 0 within [m].
std::vector<float> signed_distance(const ImageFrame& frame, const VoxelSet& set);

/// The same within each slice across `axis` alone.
std::vector<float> signed_distance_in_slices(const ImageFrame& frame, const VoxelSet& set, int axis);

}  // namespace tunica::imaging
