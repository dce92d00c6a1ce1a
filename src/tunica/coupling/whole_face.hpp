// A face of the mesh with the triangles of all ranks.
#pragma once

#include <vector>

#include "tunica/bc/face_shape.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// Each rank gets the whole face. Written reason: a flow profile is the solution of a small problem on one opening
/// (some thousand triangles of a mesh of a million), which every rank solves alike at set-up.
struct WholeFace {
  std::string name;
  std::vector<Vec3<double>> points;      ///< reference positions [m], ascending global node number
  std::vector<bc::Triangle> triangles;   ///< numbers of `points`
  std::vector<bc::Triangle> edges;       ///< numbers of `points`; empty for linear elements
  std::vector<std::int64_t> global_ids;  ///< of `points`

  bc::FaceMesh mesh() const { return {name, points, triangles, edges}; }
  /// Position of a global node number in `points`, or -1.
  std::int32_t find(std::int64_t global_id) const;
};

/// Collective.
WholeFace gather_face(const distributed::DistributedMesh& mesh, const distributed::Face& face);

}  // namespace tunica::coupling
