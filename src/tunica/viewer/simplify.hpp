// Fewer triangles for pages: surfaces of fine meshes within a stated distance.
#pragma once

#include "tunica/viewer/beat.hpp"
#include "tunica/viewer/modes.hpp"

namespace tunica::viewer {

/// Puts points and triangles into an order in which neighbours follow each other: steps of numbers become small, which
/// packs well. The blocks of points that quantities cover stay blocks. Points that no triangle uses are dropped.
void order(Body& body);

struct Simplification {
  std::size_t triangles_before = 0, triangles = 0;
  double distance = 0;                ///< of any point that was there to the surface that is left [m]
  std::vector<Deviation> deviations;  ///< of each quantity, at the points that are gone, over all times
};

/// Puts the triangles of the mesh in the place of their parts, where there are parts; takes away points, group by group
/// and without moving their borders, until `most_triangles` are left or the surface would leave the one that was by
/// more than `distance` [m]. What is left are points of the mesh with their values. Nothing more is taken from a body
/// that is small enough.
Simplification simplify(Body& body, std::size_t most_triangles, double distance);

}  // namespace tunica::viewer
