#include "tunica/coupling/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

constexpr double outside = -0.05;  // smallest barycentric coordinate: curved faces are made of flat triangles

struct Candidate {
  double inside = -std::numeric_limits<double>::max();  // smallest barycentric coordinate
  std::int64_t id = -1;
  const distributed::Region* region = nullptr;
  std::size_t element = 0;
  std::array<double, 4> corners{};
};

std::array<double, 4> barycentric(const distributed::DistributedMesh& mesh, const std::array<std::int32_t, 4>& element,
                                  const Vec3<double>& place) {
  Vec3<double> x[4];
  for (int a = 0; a < 4; ++a) x[a] = mesh.points[element[static_cast<std::size_t>(a)]];
  const auto shape = fe::gradients(x);
  std::array<double, 4> l{};
  for (int a = 0; a < 4; ++a) l[static_cast<std::size_t>(a)] = dot(shape.dN[a], place - x[(a + 1) % 4]);
  return l;
}

Candidate best_element(const distributed::DistributedMesh& mesh, const ProbePlace& probe) {
  Candidate best;
  for (const auto& region : mesh.regions) {
    if (region.kind != probe.region) continue;
    for (std::int32_t e = 0; e < region.owned_elements; ++e) {
      const auto l = barycentric(mesh, region.elements[e], probe.place);
      const double inside = *std::min_element(l.begin(), l.end());
      if (inside > best.inside || (inside == best.inside && region.element_ids[e] < best.id))
        best = {inside, region.element_ids[e], &region, static_cast<std::size_t>(e), l};
    }
  }
  return best;
}

}  // namespace

Probes::Probes(const distributed::DistributedMesh& mesh, std::span<const ProbePlace> places)
    : mesh_(mesh), probes_(places.size()) {
  std::vector<tunica::Problem> problems;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Candidate best = best_element(mesh, places[k]);
    const double inside = parallel::global_max(mesh.comm, best.inside);
    if (!(inside >= outside)) {
      const auto& x = places[k].place;
      problems.push_back({"output.points." + places[k].name,
                          fmt::format("({:.6g}, {:.6g}, {:.6g}) m lies outside of the {}", x[0], x[1], x[2],
                                      places[k].region == mesh::RegionKind::lumen ? "lumen" : "wall"),
                          "give a place inside the initial mesh, and the `region` that it lies in"});
      continue;
    }
    const std::int64_t none = std::numeric_limits<std::int64_t>::max();
    const std::int64_t id = parallel::global_min(mesh.comm, best.inside == inside ? best.id : none);
    if (best.inside != inside || best.id != id) continue;
    Found& found = found_.emplace_back();
    found.probe = k;
    found.corners = best.corners;
    const auto point = fe::quadratic_point(best.corners, 1.0);
    distributed::for_each_node(*best.region, best.element, [&](std::int32_t node) { found.nodes.push_back(node); });
    for (std::size_t a = 0; a < found.nodes.size(); ++a)
      found.shares.push_back(mesh.quadratic ? point.N[a] : best.corners[a]);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::vector<ProbeRecord> Probes::evaluate(const State& state) const {
  constexpr std::size_t width = 7;
  std::vector<double> values(width * probes_, 0.0);
  for (const auto& f : found_) {
    double* v = values.data() + width * f.probe;
    for (std::size_t a = 0; a < f.nodes.size(); ++a)
      for (std::size_t c = 0; c < 3; ++c) {
        v[c] += f.shares[a] * state.displacement[at(f.nodes[a]) + c];
        v[3 + c] += f.shares[a] * state.velocity_pressure[at(f.nodes[a]) + c];
      }
    for (std::size_t a = 0; a < 4; ++a) v[6] += f.corners[a] * state.velocity_pressure[at(f.nodes[a]) + 3];
  }
  parallel::global_sum(mesh_.comm, values);
  std::vector<ProbeRecord> records;
  for (std::size_t k = 0; k < probes_; ++k) {
    const double* v = values.data() + width * k;
    records.push_back({{{v[0], v[1], v[2]}}, {{v[3], v[4], v[5]}}, v[6]});
  }
  return records;
}

}  // namespace tunica::coupling
