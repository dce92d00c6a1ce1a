// The plane that a face lies in.
#pragma once

#include "tunica/base/tensor.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// Unit normal of the area vector of the whole face, outwards; of a closed surface zero. Collective.
Vec3<double> mean_normal(const distributed::DistributedMesh& mesh, const distributed::Face& face);

/// Largest distance of its nodes from the mean plane, over the radius of a circle of its area: 0 for a plane, infinite
/// for a closed surface (`normal` zero). Collective.
double out_of_plane(const distributed::DistributedMesh& mesh, const distributed::Face& face,
                    const Vec3<double>& normal);

}  // namespace tunica::coupling
