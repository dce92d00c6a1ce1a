#include "tunica/quantities/fibres.hpp"

#include "tunica/wall/parameters.hpp"

namespace tunica::quantities {

std::vector<Vec3<double>> families_of(const coupling::Problem& problem, std::size_t region) {
  const wall::Parameters& wall = *problem.input().wall;
  const auto own = wall.regions.find(problem.mesh().regions[region].name);
  return wall::mean_fibre_directions(own == wall.regions.end() ? wall.material : own->second.material);
}

}  // namespace tunica::quantities
