// Where blood passes from the true to the false lumen.
#pragma once

#include <vector>

#include "tunica/geometry/tetrahedra.hpp"

namespace tunica::meshing {

struct Tear {
  geometry::Point centre;                   ///< m
  Vec3<double> normal;                      ///< unit, towards the true lumen
  double area = 0;                          ///< of its rim, seen along the normal [m^2]
  std::vector<geometry::Index> elements{};  ///< that it cuts
};

/// `side`: of each lumen node, > 0 in the true lumen (`WallRegions`). A tear is a connected piece of the surface inside
/// the lumen on which it is zero; by falling area.
std::vector<Tear> find_tears(const geometry::Tetrahedra& mesh, const std::vector<double>& side);

}  // namespace tunica::meshing
