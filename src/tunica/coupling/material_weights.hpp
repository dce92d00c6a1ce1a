// From what regions of the wall are composed of to the weight of every material in every element.
#pragma once

#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/wall/composition.hpp"

namespace tunica::coupling {

/// Points of an element at which its materials have a weight each: those of the quadratic element where one of them
/// lies in layers, else none.
int weight_points(const distributed::DistributedMesh& mesh, const std::vector<const wall::Composition*>& compositions);

/// Weights of the materials of all compositions in each local element, one composition after the other, [region]
/// [element][at its centroid, then at each of weight_points()][material]; every row sums to 1. `of_composition`:
/// weights of the compositions (blend_regions). Depth and share are those of the elements, in neighbouring regions as
/// well where these blend. A depth is one value for each element, or four, of its corners. Throws InputError for an
/// array that the mesh does not have, one with another number of components, and values that are not finite or, of
/// shares, not within 0 and 1. Collective.
std::vector<std::vector<double>> material_weights(const distributed::DistributedMesh& mesh,
                                                  const std::vector<const wall::Composition*>& compositions,
                                                  const std::vector<std::vector<double>>& of_composition);

}  // namespace tunica::coupling
