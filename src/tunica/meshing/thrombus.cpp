#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "tunica/base/disjoint_sets.hpp"
#include "tunica/geometry/triangle_tree.hpp"
#include "tunica/mesh/boundary.hpp"
#include "tunica/meshing/local_mesh.hpp"
#include "tunica/meshing/wall_regions.hpp"

namespace tunica::meshing {

namespace {

using geometry::Index;
using geometry::Tetrahedra;
using Edge = std::array<Index, 2>;

constexpr int thrombus_label = geometry::wall_label + 1;  ///< while shapes are mended, so that its surface is kept
constexpr double near_an_end = 0.2;                       ///< of an edge: there its node is taken for the crossing

/// Of the wall, each once.
std::vector<Edge> edges_of_wall(const Tetrahedra& mesh) {
  std::vector<Edge> edges;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t a = 0; a < 4 && mesh.labels[e] == geometry::wall_label; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const auto p = mesh.elements[e][a], q = mesh.elements[e][b];
        edges.push_back({std::min(p, q), std::max(p, q)});
      }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Elements that lie in the thrombus, without its specks, and their volume. `holds(e)`: does element e?
template <class Holds>
std::pair<std::vector<std::size_t>, double> pieces_of(const Tetrahedra& mesh, double smallest, const Holds& holds) {
  std::vector<std::size_t> inside;
  base::DisjointSets pieces(std::ssize(mesh.points));  // of nodes that elements inside share
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.labels[e] != geometry::wall_label || !holds(e)) continue;
    inside.push_back(e);
    for (const auto node : mesh.elements[e]) pieces.join(node, mesh.elements[e][0]);
  }
  std::map<std::int64_t, double> volume;
  const auto of = [&](std::size_t e) { return pieces.set_of(mesh.elements[e][0]); };
  for (const auto e : inside) volume[of(e)] += std::abs(mesh::volume(mesh.points, mesh.elements[e]));
  std::erase_if(inside, [&](std::size_t e) { return volume[of(e)] <= smallest; });
  double sum = 0;
  for (const auto& [piece, size] : volume)
    if (size > smallest) sum += size;
  return {std::move(inside), sum};
}

}  // namespace

Thrombus thrombus_within(const geometry::TriangleSurface& body, double voxel) {
  const auto tree = std::make_shared<const geometry::TriangleTree>(body);
  const auto depth = [tree](const geometry::Point& place) {
    const auto nearest = tree->nearest(place);
    return tree->is_behind(place, nearest) ? nearest.distance : -nearest.distance;
  };
  return {depth, 0.3 * voxel, 10 * std::pow(voxel, 3)};
}

Index part_thrombus(Tetrahedra& mesh, const Thrombus& thrombus, const Projection& project,
                    const std::function<void(const std::string&)>& tell) {
  std::vector<double> depth(mesh.points.size(), 0.0);
  std::vector<bool> of_wall(mesh.points.size());
  auto edges = edges_of_wall(mesh);
  for (const auto& edge : edges)
    for (const auto node : edge) of_wall[static_cast<std::size_t>(node)] = true;
  for (std::size_t n = 0; n < depth.size(); ++n) {
    if (!of_wall[n]) continue;
    const double value = thrombus.depth(mesh.points[n]);
    depth[n] = std::abs(value) <= thrombus.tolerance ? 0 : value;
  }
  const auto length = [&](const Edge& e) { return norm(mesh.points[e[0]] - mesh.points[e[1]]); };
  std::stable_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
  // Where a node all but lies there already, no other one is put beside it.
  const double close = 2 * thrombus.tolerance;
  for (auto e = edges.rbegin(); e != edges.rend(); ++e) {
    auto &a = depth[static_cast<std::size_t>((*e)[0])], &b = depth[static_cast<std::size_t>((*e)[1])];
    if (a * b >= 0) continue;
    if (const double share = a / (a - b); share < near_an_end && std::abs(a) < close)
      a = 0;
    else if (share > 1 - near_an_end && std::abs(b) < close)
      b = 0;
  }
  LocalMesh local(mesh);
  Index added = 0;
  for (const auto& [p, q] : edges) {
    const double a = depth[static_cast<std::size_t>(p)], b = depth[static_cast<std::size_t>(q)];
    if (a * b >= 0) continue;
    const auto node = local.split(static_cast<LocalMesh::Node>(p), static_cast<LocalMesh::Node>(q));
    const auto& from = mesh.points[static_cast<std::size_t>(p)];
    local.move(node, from + (a / (a - b)) * (mesh.points[static_cast<std::size_t>(q)] - from));
    ++added;
  }
  mesh = local.extract();
  depth.resize(mesh.points.size(), 0.0);
  const auto [inside, volume] = pieces_of(mesh, thrombus.smallest, [&](std::size_t e) {
    double sum = 0;
    for (const auto node : mesh.elements[e]) sum += depth[static_cast<std::size_t>(node)];
    return sum > 0;
  });
  for (const auto e : inside) mesh.labels[e] = thrombus_label;
  const auto keep = [&](geometry::Point& p, const geometry::Point& normal, int from, int to, double reach) {
    if (from != thrombus_label && to != thrombus_label) return project(p, normal, from, to, reach);
    // Its surface to the lumen is one of the mesh; nodes between it and the wall stay where they are.
    const auto as_wall = [](int label) { return label == thrombus_label ? geometry::wall_label : label; };
    return as_wall(from) != as_wall(to) && project(p, normal, as_wall(from), as_wall(to), reach);
  };
  improve(mesh, keep, {}, tell);
  for (auto& label : mesh.labels)
    if (label == thrombus_label) label = geometry::wall_label;
  return added;
}

double mark_thrombus(const Tetrahedra& mesh, const Thrombus& thrombus, WallRegions& regions) {
  const auto [inside, volume] = pieces_of(mesh, thrombus.smallest, [&](std::size_t e) {
    return thrombus.depth(mesh::centroid(mesh.points, mesh.elements[e])) > 0.5 * thrombus.tolerance;
  });
  // The wall behind it belongs to the lumen that it lies in.
  base::DisjointSets pieces(std::ssize(mesh.points));
  std::vector<bool> clotted(mesh.points.size());
  for (const auto e : inside)
    for (const auto node : mesh.elements[e]) {
      pieces.join(node, mesh.elements[e][0]);
      clotted[static_cast<std::size_t>(node)] = true;
    }
  std::map<std::int64_t, double> side;
  for (std::size_t n = 0; n < clotted.size(); ++n)
    if (clotted[n]) side[pieces.set_of(static_cast<std::int64_t>(n))] += regions.side[n];
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    auto& region = regions.of_element[e];
    if (mesh.labels[e] != geometry::wall_label ||
        (region != WallRegion::true_lumen_wall && region != WallRegion::false_lumen_wall))
      continue;
    const auto& nodes = mesh.elements[e];
    const auto at =
        std::find_if(nodes.begin(), nodes.end(), [&](Index n) { return clotted[static_cast<std::size_t>(n)]; });
    if (at == nodes.end()) continue;
    const double of_piece = side[pieces.set_of(*at)];
    const bool faces_other = std::any_of(
        nodes.begin(), nodes.end(), [&](Index n) { return regions.side[static_cast<std::size_t>(n)] * of_piece < 0; });
    if (!faces_other) region = of_piece < 0 ? WallRegion::false_lumen_wall : WallRegion::true_lumen_wall;
  }
  for (const auto e : inside) regions.of_element[e] = WallRegion::thrombus;
  return volume;
}

}  // namespace tunica::meshing
