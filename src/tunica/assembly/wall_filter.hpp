// A smoothing filter on the nodes of the wall.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/assembly/scalar_system.hpp"
#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::assembly {

/// Solves w - l^2 div grad w = source in all wall regions, without flux through the surface, on linear elements
/// (Lazarov & Sigmund 2011, doi:10.1002/nme.3072, eq. 9). What one place is given decays over the length l.
class WallFilter {
 public:
  /// `length`: l [m] > 0. `name` begins the messages of errors. Collective.
  WallFilter(const distributed::DistributedMesh& mesh, double length, const std::string& name);

  /// w on all local nodes, 0 outside the wall. `load`: integral of the source times the shape function of each owned
  /// node; 0 outside the wall. Throws SolverError when the linear solver fails. Collective.
  std::vector<double> apply(std::span<const double> load) { return system_.solve(load); }

 private:
  ScalarSystem system_;
};

}  // namespace tunica::assembly
