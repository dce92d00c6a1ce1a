#include "tunica/meshing/fidelity.hpp"

#include <algorithm>

namespace tunica::meshing {

namespace {

void measure(const geometry::TriangleSurface& from, const geometry::TriangleTree& to, const geometry::SizeField& sizes,
             SurfaceFidelity& result) {
  const auto at = [&](const geometry::Point& p) {
    const double distance = to.nearest(p).distance;
    result.largest_distance = std::max(result.largest_distance, distance);
    result.largest_per_edge = std::max(result.largest_per_edge, distance / sizes(p));
  };
  for (const auto& p : from.points) at(p);
  for (const auto& t : from.triangles) at((1.0 / 3) * (from.points[t[0]] + from.points[t[1]] + from.points[t[2]]));
}

SurfaceFidelity compare(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 3>>& triangles,
                        const geometry::TriangleTree& original, const geometry::SizeField& sizes) {
  geometry::TriangleSurface surface{mesh.points, triangles};
  geometry::drop_unused_points(surface);
  SurfaceFidelity result;
  measure(surface, original, sizes, result);
  measure(original.surface(), geometry::TriangleTree(surface), sizes, result);
  return result;
}

}  // namespace

Fidelity fidelity(const geometry::Tetrahedra& mesh, const std::vector<std::array<geometry::Index, 3>>& interface,
                  const std::vector<std::array<geometry::Index, 3>>& outer, const PreparedSurfaces& prepared) {
  Fidelity result;
  result.lumen = compare(mesh, interface, prepared.lumen, prepared.sizes);
  const auto* outer_surface = prepared.outer ? &prepared.outer->surface() : nullptr;
  if (prepared.outer) result.outer = compare(mesh, outer, *prepared.outer, prepared.sizes);
  const auto original = close_at_openings(prepared.lumen.surface(), outer_surface, prepared.openings);
  result.lumen_volume = volume(original, Label::lumen);
  result.wall_volume = volume(original, Label::wall);
  return result;
}

}  // namespace tunica::meshing
