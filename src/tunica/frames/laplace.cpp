#include "tunica/frames/laplace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tunica/assembly/scalar_system.hpp"
#include "tunica/base/error.hpp"
#include "tunica/distributed/element_shape.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::frames {

namespace {

/// Assembles the rows of owned nodes. A group of nodes is one unknown, that of its node of lowest number.
class Assembly {
 public:
  Assembly(const distributed::DistributedMesh& mesh, Domain domain, const LaplaceConditions& conditions)
      : mesh_(mesh),
        domain_(domain),
        value_(conditions.value),
        group_(conditions.group),
        inflow_(conditions.flux),
        leader_(inflow_.size(), std::numeric_limits<std::int64_t>::max()),
        rhs(static_cast<std::size_t>(mesh.owned_nodes), 0.0) {
    mesh.halo.update(value_, 1);
    mesh.halo.update(group_, 1);
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      if (const auto g = group(i); g >= 0) leader_[g] = std::min(leader_[g], mesh.global_ids[i]);
    MPI_Allreduce(MPI_IN_PLACE, leader_.data(), static_cast<int>(leader_.size()), MPI_INT64_T, MPI_MIN, mesh.comm);
    in_domain_.assign(static_cast<std::size_t>(mesh.owned_nodes), 0);
    for (const auto& region : mesh.regions)
      if (includes(domain, region.kind))
        for (const auto& element : region.elements) add(element);
    finish();
  }

  /// Whether any value is prescribed in the domain. Collective.
  bool has_values() const { return parallel::any(mesh_.comm, has_values_); }

  /// phi of all nodes from that of the unknowns. Collective.
  void expand(std::vector<double>& phi) const {
    std::vector<double> common(leader_.size(), 0.0);
    for (std::size_t g = 0; g < leader_.size(); ++g)
      if (is_mine(leader_[g])) common[g] = phi[static_cast<std::size_t>(leader_[g] - mesh_.first_global)];
    parallel::global_sum(mesh_.comm, common);
    for (std::int32_t i = 0; i < mesh_.nodes(); ++i)
      if (const auto g = group(i); g >= 0) phi[i] = common[g];
    if (domain_ == Domain::lumen_and_wall)
      for (std::int32_t i = 0; i < mesh_.nodes(); ++i) phi[i] = phi[mesh_.host[i]];
  }

 private:
  bool fixed(std::int32_t node) const { return !std::isnan(value_[node]); }
  int group(std::int32_t node) const { return fixed(node) ? -1 : static_cast<int>(group_[node]); }
  bool is_mine(std::int64_t id) const {
    return id >= mesh_.first_global && id < mesh_.first_global + mesh_.owned_nodes;
  }
  std::int64_t unknown(std::int32_t node) const {
    return group(node) >= 0 ? leader_[group(node)] : mesh_.global_ids[node];
  }

  void add(const std::array<std::int32_t, 4>& element) {
    const auto shape = distributed::shape(mesh_, element);
    for (int a = 0; a < 4; ++a) {
      const auto row = carrier(mesh_, domain_, element[a]);
      if (row >= mesh_.owned_nodes) continue;
      in_domain_[row] = 1;
      has_values_ = has_values_ || fixed(row);
      if (fixed(row)) continue;
      for (int b = 0; b < 4; ++b) {
        const auto column = carrier(mesh_, domain_, element[b]);
        const double k = shape.volume * dot(shape.dN[a], shape.dN[b]);
        if (!fixed(column))
          entries.add(unknown(row), unknown(column), k);
        else
          (group(row) >= 0 ? lost_[group(row)] : rhs[row]) -= k * value_[column];
      }
    }
  }

  void finish() {
    parallel::global_sum(mesh_.comm, lost_);
    for (std::size_t g = 0; g < leader_.size(); ++g)
      if (is_mine(leader_[g])) rhs[static_cast<std::size_t>(leader_[g] - mesh_.first_global)] = inflow_[g] + lost_[g];
    for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i) {
      if (in_domain_[i] && !fixed(i) && unknown(i) == mesh_.global_ids[i]) continue;
      entries.add(mesh_.global_ids[i], mesh_.global_ids[i], 1.0);
      rhs[i] = fixed(i) ? value_[i] : 0.0;
    }
  }

  const distributed::DistributedMesh& mesh_;
  Domain domain_;
  std::vector<double> value_, group_, inflow_;
  std::vector<std::int64_t> leader_;  ///< global node of each group
  std::vector<double> lost_ = std::vector<double>(inflow_.size(), 0.0);
  std::vector<char> in_domain_;
  bool has_values_ = false;

 public:
  assembly::ScalarEntries entries;
  std::vector<double> rhs;
};

}  // namespace

LaplaceConditions::LaplaceConditions(const distributed::DistributedMesh& mesh)
    : value(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::quiet_NaN()),
      group(static_cast<std::size_t>(mesh.nodes()), -1.0) {}

bool includes(Domain domain, mesh::RegionKind kind) {
  return domain == Domain::lumen_and_wall || (domain == Domain::wall) == (kind == mesh::RegionKind::wall);
}

LaplaceSolution solve_laplace(const distributed::DistributedMesh& mesh, Domain domain,
                              const LaplaceConditions& conditions, const std::string& name) {
  Assembly assembled(mesh, domain, conditions);
  if (!assembled.has_values()) throw SolverError(name + ": no value is prescribed on the domain.");
  assembly::ScalarSystem system(mesh, assembled.entries, name);
  assembled.entries = {};
  LaplaceSolution solution{system.solve(assembled.rhs), system.iterations()};
  assembled.expand(solution.phi);
  return solution;
}

}  // namespace tunica::frames
