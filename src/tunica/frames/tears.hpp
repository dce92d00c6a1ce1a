// Where the lumens of a dissection communicate.
#pragma once

#include <string>
#include <vector>

#include "tunica/frames/element_graph.hpp"
#include "tunica/frames/laplace.hpp"

namespace tunica::frames {

/// The harmonic function in the lumen that is 1 on the walls of the true and -1 on those of the false lumen, with no
/// flux through the flap and elsewhere. Throws InputError when a region does not exist or no interface node touches
/// either kind of wall. Collective.
LaplaceSolution lumen_sides(const distributed::DistributedMesh& mesh, const LumenWalls& walls);

/// Centroids [m] of the lumen elements in which `lumen_sides` changes its sign: they lie across the tears. All of
/// them on every rank, in an order that depends on the ranks. Throws as lumen_sides, and InputError when there is no
/// such element. Collective.
std::vector<Vec3<double>> tear_points(const distributed::DistributedMesh& mesh, const LumenWalls& walls);

/// Distance of the centroid of each owned element to the nearest of `points` [m].
std::vector<double> distances(const ElementGraph& graph, const std::vector<Vec3<double>>& points);

}  // namespace tunica::frames
