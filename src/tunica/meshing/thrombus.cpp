#include <cmath>
#include <map>

#include "tunica/base/disjoint_sets.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::meshing {

double mark_thrombus(const geometry::Tetrahedra& mesh, const geometry::TriangleSurface& body, double voxel,
                     WallRegions& regions) {
  const geometry::TriangleTree tree(body);
  std::vector<std::size_t> inside;
  base::DisjointSets pieces(std::ssize(mesh.points));  // of nodes that elements inside share
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] == geometry::lumen_label) continue;
    const auto centre = mesh::centroid(mesh.points, mesh.elements[e]);
    const auto nearest = tree.nearest(centre);
    if (nearest.distance < 0.3 * voxel || !tree.is_behind(centre, nearest)) continue;
    inside.push_back(e);
    for (const auto node : mesh.elements[e]) pieces.join(node, mesh.elements[e][0]);
  }
  std::map<std::int64_t, double> volume;
  const auto of = [&](std::size_t e) { return pieces.set_of(mesh.elements[e][0]); };
  for (const auto e : inside) volume[of(e)] += std::abs(mesh::volume(mesh.points, mesh.elements[e]));
  const double smallest = 10 * std::pow(voxel, 3);
  for (const auto e : inside)
    if (volume[of(e)] > smallest) regions.of_element[e] = WallRegion::thrombus;
  double sum = 0;
  for (const auto& [piece, size] : volume)
    if (size > smallest) sum += size;
  return sum;
}

}  // namespace tunica::meshing
