// Geometry of the elements of a distributed mesh.
#pragma once

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/fe/tetrahedron.hpp"

namespace tunica::distributed {

/// Gradients of the shape functions, and the volume; `element`: local nodes.
inline fe::Gradients<double> shape(const DistributedMesh& mesh, const std::array<std::int32_t, 4>& element) {
  const Vec3<double> x[4] = {mesh.points[element[0]], mesh.points[element[1]], mesh.points[element[2]],
                             mesh.points[element[3]]};
  return fe::gradients(x);
}

inline Vec3<double> centroid(const DistributedMesh& mesh, const std::array<std::int32_t, 4>& element) {
  return 0.25 *
         ((mesh.points[element[0]] + mesh.points[element[1]]) + (mesh.points[element[2]] + mesh.points[element[3]]));
}

}  // namespace tunica::distributed
