// Remeshes surfaces together until all of them are near their originals and none crosses another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tunica/geometry/remesh.hpp"

namespace tunica::meshing {

/// Takes one line of progress.
using Log = std::function<void(const std::string&)>;

struct Accuracy {
  double per_edge = 0.3;     ///< largest distance from the original over the edge length asked for there
  double absolute = 0.5e-3;  ///< largest distance from the original [m]
  int rounds = 8;            ///< of remeshing with finer edges where the bounds do not hold
  int few = 12;              ///< so many places, 4 mm apart, may stay too far with a warning, where nothing crosses
  double farthest = 1.5e-3;  ///< no place may stay farther than this [m]
};

/// A surface, what it is made from, and how fine it is to be.
struct Sheet {
  geometry::Original original;
  geometry::Remeshed mesh;    ///< the result
  std::vector<double> asked;  ///< the sizes of `original` at first, by which accuracy is judged
  double distance = 0;        ///< largest one between mesh and original, both ways [m]
  double relative = 0;        ///< the same over the edge length asked for there
};

/// Remeshes all sheets. Where a mesh is too far from its original or two triangles of any sheets cross, sizes are
/// lowered and the sheets remeshed again, until that helps no more: in the last round, or when there have been more
/// such places for two rounds, or few are left and two rounds have not made them fewer. Logs one line for each round,
/// and a warning for a few places that stay too far. SolverError with places when triangles cross in the end, or more
/// places are too far.
void remesh_together(std::vector<Sheet>& sheets, const Accuracy& accuracy, double gradation, const Log& log);

}  // namespace tunica::meshing
