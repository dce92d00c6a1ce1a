// The fibre frame of every element of a region.
#pragma once

#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/wall/fibre_frame.hpp"

namespace tunica::coupling {

/// e1 and e2 of each local element, [element][6]; e3 = e1 x e2. Frames that depend on the place are taken at the
/// centroid. Throws InputError naming the element where there is no frame.
std::vector<double> fibre_frames(const distributed::DistributedMesh& mesh, const distributed::Region& region,
                                 const wall::FrameSource& source);

}  // namespace tunica::coupling
