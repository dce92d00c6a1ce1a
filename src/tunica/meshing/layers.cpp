#include "tunica/meshing/layers.hpp"

#include <algorithm>

#include "tunica/meshing/local_mesh.hpp"
#include "tunica/meshing/reconnect.hpp"

namespace tunica::meshing {

geometry::Index double_layers(geometry::Tetrahedra& mesh, std::vector<std::array<geometry::Index, 2>> bridges) {
  const auto length = [&](const std::array<geometry::Index, 2>& e) {
    return norm(mesh.points[e[0]] - mesh.points[e[1]]);
  };
  std::stable_sort(bridges.begin(), bridges.end(), [&](const auto& a, const auto& b) { return length(a) > length(b); });
  LocalMesh local(mesh);
  using Node = LocalMesh::Node;
  std::vector<Node> added;
  for (const auto& e : bridges) added.push_back(local.split(static_cast<Node>(e[0]), static_cast<Node>(e[1])));
  // One new node for each edge is many more than a layer needs.
  constexpr double least_sine = 0.2;  // 12 degrees: shapes that improve() can work with
  geometry::Index removed = 0;
  for (int sweep = 0; sweep < 3; ++sweep)
    for (const Node n : added)
      if (!local.star(n).empty() && merge_into_neighbour(local, n, least_sine)) ++removed;
  mesh = local.extract();
  return std::ssize(added) - removed;
}

}  // namespace tunica::meshing
