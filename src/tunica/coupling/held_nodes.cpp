#include "tunica/coupling/held_nodes.hpp"

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
    v[9] = held[i].pressure ? 1.0 : 0.0;
  }
  mesh.halo.update(values, 10);
  std::vector<assembly::NodeConstraint> list;
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const double* v = values.data() + 10 * static_cast<std::size_t>(i);
    Held h;
    for (int k = 0; k < 9; ++k) h.P(k / 3, k % 3) = v[k];
    h.pressure = v[9] > 0.5;
    if (h.any()) list.push_back({i, h.P, h.pressure});
  }
  return list;
}

}  // namespace tunica::coupling
