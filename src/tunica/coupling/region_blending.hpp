// Materials that go continuously from one region of the wall to the next.
#pragma once

#include <vector>

#include "tunica/distributed/distributed_mesh.hpp"

namespace tunica::coupling {

/// Weight of each material in each local element, [region][element][material], of which every row sums to 1; empty for
/// regions of the lumen. `material_of_region`: index of the material, -1 in the lumen.
///
/// With a smoothing length [m], the indicator of a material (1 in its regions, 0 in the others) passes the Helmholtz
/// filter
///   w - l^2 div grad w = indicator,   no flux through the surface,   l = length / (2 sqrt 3)
/// on linear elements (Lazarov & Sigmund 2011, doi:10.1002/nme.3072, eq. 9), so that w turns from 0 to 1 over about
/// `length` and no sum of weights changes. Elements take the mean of their nodes; weights below 1e-3 are dropped.
/// Regions that share nodes blend; a gap does not. Length 0 leaves the materials as they are. Throws SolverError when
/// the linear solver fails. Collective.
std::vector<std::vector<double>> blend_regions(const distributed::DistributedMesh& mesh,
                                               const std::vector<int>& material_of_region, int materials,
                                               double length);

}  // namespace tunica::coupling
