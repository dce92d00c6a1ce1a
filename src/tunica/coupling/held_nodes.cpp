#include "tunica/coupling/held_nodes.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace tunica::coupling {

void Held::direction(const Vec3<double>& n) {
  Vec3<double> d = P * n;  // what the earlier directions leave of it
  const double size = norm(d);
  if (size < 1e-6) return;
  d = (1.0 / size) * d;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) P(i, j) -= d[i] * d[j];
}

std::vector<assembly::NodeConstraint> complete_on_ghosts(const distributed::DistributedMesh& mesh,
                                                         const std::vector<Held>& held) {
  std::vector<double> values(10 * static_cast<std::size_t>(mesh.nodes()));
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    double* v = values.data() + 10 * static_cast<std::size_t>(i);
    for (int k = 0; k < 9; ++k) v[k] = held[i].P(k / 3, k % 3);
    v[9] = held[i].unused ? 2.0 : held[i].pressure ? 1.0 : 0.0;
  }
  mesh.halo.update(values, 10);
  std::vector<assembly::NodeConstraint> list;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const double* v = values.data() + 10 * static_cast<std::size_t>(i);
    Held h;
    for (int k = 0; k < 9; ++k) h.P(k / 3, k % 3) = v[k];
    h.pressure = v[9] > 0.5, h.unused = v[9] > 1.5;
    if (h.any()) list.push_back({i, h.P, h.pressure, h.unused});
  }
  return list;
}

std::vector<IdlePressure> find_idle_pressures(const distributed::DistributedMesh& mesh, const std::vector<Held>& held) {
  if (!mesh.quadratic) return {};
  std::vector<double> mobile(mesh.nodes());
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) mobile[i] = trace(held[i].P);
  mesh.halo.update(mobile, 1);
  const auto moves = [&](std::int32_t node) { return mobile[mesh.host[node]] > 0; };
  std::map<std::int32_t, IdlePressure> still;
  std::vector<char> balanced(mesh.nodes(), 0);
  for (const auto& region : mesh.regions) {
    if (region.kind != mesh::RegionKind::lumen) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& corners = region.elements[e];
      const auto& edges = region.edges[e];
      const bool any =
          std::any_of(corners.begin(), corners.end(), moves) || std::any_of(edges.begin(), edges.end(), moves);
      for (const auto node : corners) {
        balanced[node] |= any;
        if (any || node >= mesh.owned_nodes) continue;
        auto& idle = still[node];
        idle.node = node;
        std::copy_if(corners.begin(), corners.end(), std::back_inserter(idle.corners),
                     [&](std::int32_t corner) { return corner != node; });
      }
    }
  }
  std::vector<IdlePressure> idle;
  for (auto& [node, found] : still)
    if (!balanced[node]) idle.push_back(std::move(found));
  return idle;
}

}  // namespace tunica::coupling
