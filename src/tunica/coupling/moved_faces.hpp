// Wall faces whose displacement is prescribed.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tunica/bc/conditions.hpp"
#include "tunica/bc/velocity_profile.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

class MovedFaces {
 public:
  /// The faces of `conditions` with a `displacement`. What other conditions fix at a node stays at rest; of two faces
  /// that move a node along the same axis the later one counts. Throws InputError for a table that cannot be read.
  /// Collective.
  MovedFaces(const distributed::DistributedMesh& mesh,
             std::span<const std::pair<std::string, bc::Condition>> conditions);

  /// Calls `visit` for each node of them, ghosts included, with node, axis and displacement [m] at time t [s]. The
  /// nodes are hosts.
  void at(double t, const std::function<void(std::int32_t, int, double)>& visit) const;

 private:
  struct Motion {
    std::int32_t node;
    int axis;
    double per_unit;  ///< m; not where `history` is given
    std::size_t course;
    std::int32_t history = -1;  ///< in histories_
  };
  struct FaceCourse {
    bc::Waveform course;
    std::optional<bc::PointTable> table;
  };
  void look_up_histories(const distributed::DistributedMesh& mesh);

  std::vector<FaceCourse> courses_;
  std::vector<Motion> motions_;
  std::vector<std::vector<Vec3<double>>> histories_;  ///< of nodes of faces with a table [m]
};

}  // namespace tunica::coupling
