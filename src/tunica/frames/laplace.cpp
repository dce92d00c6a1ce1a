#include "tunica/frames/laplace.hpp"

#include <cmath>
#include <limits>

#include "tunica/assembly/scalar_system.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/element_shape.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

LaplaceConditions::LaplaceConditions(const mesh::DistributedMesh& mesh)
    : value(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::quiet_NaN()),
      flux(static_cast<std::size_t>(mesh.owned_nodes), 0.0) {}

bool includes(Domain domain, mesh::RegionKind kind) {
  return domain == Domain::lumen_and_wall || (domain == Domain::wall) == (kind == mesh::RegionKind::wall);
}

LaplaceSolution solve_laplace(const mesh::DistributedMesh& mesh, Domain domain, const LaplaceConditions& conditions,
                              const std::string& name) {
  std::vector<double> prescribed = conditions.value;
  mesh.halo.update(prescribed, 1);
  const auto fixed = [&](std::int32_t node) { return !std::isnan(prescribed[node]); };
  std::vector<double> rhs = conditions.flux;
  std::vector<char> free(static_cast<std::size_t>(mesh.owned_nodes), 0);
  bool any_fixed = false;
  assembly::ScalarEntries entries;
  for (const auto& region : mesh.regions) {
    if (!includes(domain, region.kind)) continue;
    for (const auto& element : region.elements) {
      const auto g = mesh::shape(mesh, element);
      for (int a = 0; a < 4; ++a) {
        const auto row = carrier(mesh, domain, element[a]);
        if (row >= mesh.owned_nodes) continue;
        any_fixed = any_fixed || fixed(row);
        if (fixed(row)) continue;
        free[row] = 1;
        for (int b = 0; b < 4; ++b) {
          const auto column = carrier(mesh, domain, element[b]);
          const double k = g.volume * dot(g.dN[a], g.dN[b]);
          if (fixed(column))
            rhs[row] -= k * prescribed[column];
          else
            entries.add(mesh.global_ids[row], mesh.global_ids[column], k);
        }
      }
    }
  }
  if (!parallel::any(mesh.comm, any_fixed)) throw SolverError(name + ": no value is prescribed on the domain.");
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    if (free[i]) continue;
    entries.add(mesh.global_ids[i], mesh.global_ids[i], 1.0);
    rhs[i] = fixed(i) ? prescribed[i] : 0.0;
  }
  assembly::ScalarSystem system(mesh, entries, name);
  entries = {};
  LaplaceSolution solution{system.solve(rhs), system.iterations()};
  if (domain == Domain::lumen_and_wall)
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) solution.phi[i] = solution.phi[mesh.host[i]];
  return solution;
}

}  // namespace tunica::frames
