// New triangles for a surface: near-equilateral, of a given size at each place, and close to the old ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tunica/geometry/triangle_tree.hpp"

namespace tunica::geometry {

/// An edge, by its points.
using Segment = std::array<std::int64_t, 2>;

/// What a surface is remeshed after.
struct Original {
  TriangleTree tree;
  std::vector<Segment> creases;  ///< sharp edges that are kept
  std::vector<double> sizes;     ///< wanted edge length [m] at its points
};

struct Remeshed {
  TriangleSurface surface;
  std::vector<Segment> creases;  ///< edges of `surface` along the creases of the original
};

/// Edges where the surface turns by more than 50 degrees and which form chains of at least three; single ones are
/// taken for noise. No point has more than two.
std::vector<Segment> find_creases(const TriangleSurface& surface);

struct RemeshOptions {
  int sweeps = 8;
  bool keep_boundary = false;  ///< neither move nor split nor remove points of open edges
};

/// Splits, collapses and flips edges and moves points along the surface (Botsch & Kobbelt 2004; sizes as in Dunyach et
/// al. 2013) until edges have the wanted length. Points stay on the original, each on its own side of a thin sheet,
/// those of open edges and creases on these lines, ends and crossings of lines in place; in the end points move off it
/// by the mean deviation of their triangles or lines, so that volumes and the areas of holes are kept. The topology
/// never changes.
///
/// `start`: manifold surface near the original, often itself.
Remeshed remesh(const Remeshed& start, const Original& original, const RemeshOptions& options = {});

}  // namespace tunica::geometry
