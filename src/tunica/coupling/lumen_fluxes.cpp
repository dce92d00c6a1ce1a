#include "tunica/coupling/lumen_fluxes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/coupling/nodal.hpp"
#include "tunica/distributed/element_nodes.hpp"
#include "tunica/fe/quadratic_triangle.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/fluid/rbvms.hpp"
#include "tunica/parallel/agree.hpp"

namespace tunica::coupling {

namespace {

using mesh::RegionKind;

template <std::size_t N>
Vec3<double> sum_of(const Vec3<double> (&values)[N]) {
  Vec3<double> sum{{0, 0, 0}};
  for (const auto& v : values) sum = sum + v;
  return sum;
}

/// Integral of v + v' - v^ over a linear element [m^4/s].
Vec3<double> carried(const FluxStep& step, const std::array<std::int32_t, 4>& nodes) {
  const FieldsView& f = step.fields;
  fluid::ElementState<double> s;
  gather(f.position, nodes, s.position);
  gather(f.velocity_pressure, nodes, s.velocity);
  gather(f.acceleration, nodes, s.acceleration);
  gather(f.mesh_velocity, nodes, s.mesh_velocity);
  for (int a = 0; a < 4; ++a) s.pressure[a] = f.velocity_pressure[at(nodes[a]) + 3];
  return std::visit(
      [&](const auto& law) {
        const auto flow = fluid::evaluate(s, law);
        const auto tau = fluid::stabilisation(flow, step.dt, step.parameters);
        const auto integrals = fluid::integrals(flow, tau, step.parameters.density);
        return (0.25 * flow.shape.volume) * (sum_of(s.velocity) - sum_of(s.mesh_velocity) + sum_of(integrals.v_prime));
      },
      step.parameters.viscosity);
}

/// The same over a quadratic one, which has no v'. Shape functions of corners have the integral -1/20, those of edges
/// 1/5 of the volume.
Vec3<double> carried_quadratic(const FluxStep& step, const distributed::Region& region, std::int32_t element,
                               double volume) {
  Vec3<double> corners[4], edges[6], moving[4];
  gather(step.fields.velocity_pressure, region.elements[element], corners);
  gather(step.fields.velocity_pressure, region.edges[element], edges);
  gather(step.fields.mesh_velocity, region.elements[element], moving);
  return volume * (0.2 * sum_of(edges) - 0.05 * sum_of(corners) - 0.25 * sum_of(moving));
}

fe::Gradients<double> present_shape(const FluxStep& step, const std::array<std::int32_t, 4>& nodes) {
  Vec3<double> x[4];
  gather(step.fields.position, nodes, x);
  return fe::gradients(x);
}

/// Integral of q (v - v^).n over a triangle [m^3/s].
double linear_outflow(const Vec3<double>& area, const Vec3<double> (&a)[3], const double (&q)[3]) {
  double flow = 0;
  const Vec3<double> sum = sum_of(a);
  for (int k = 0; k < 3; ++k) flow += q[k] * dot(area, sum + a[k]) / 12;
  return flow;
}

double quadratic_outflow(const Vec3<double>& area, const Vec3<double> (&a)[6], const double (&q)[3]) {
  double flow = 0;
  for (const auto& point : fe::quadratic_seven_points) {
    double at_point = 0, weight = 0;
    for (int k = 0; k < 6; ++k) at_point += point.N[k] * dot(area, a[k]);
    for (int k = 0; k < 3; ++k) weight += point.barycentric[k] * q[k];
    flow += point.weight * weight * at_point;
  }
  return flow;
}

double outflow(const FluxStep& step, const distributed::Face& face, std::size_t t, std::span<const double> q) {
  const FieldsView& f = step.fields;
  Vec3<double> x[3], v[3], w[3];
  gather(f.position, face.triangles[t], x);
  gather(f.velocity_pressure, face.triangles[t], v);
  gather(f.mesh_velocity, face.triangles[t], w);
  double of_corners[3];
  for (int a = 0; a < 3; ++a) of_corners[a] = q[face.triangles[t][a]];
  const Vec3<double> area = fluid::area_vector(x);
  if (!step.mesh.quadratic) {
    const Vec3<double> relative[3] = {v[0] - w[0], v[1] - w[1], v[2] - w[2]};
    return linear_outflow(area, relative, of_corners);
  }
  Vec3<double> v_edges[3], w_edges[3];
  gather(f.velocity_pressure, face.edges[t], v_edges);
  gather(f.mesh_velocity, face.edges[t], w_edges);
  const Vec3<double> relative[6] = {
      v[0] - w[0], v[1] - w[1], v[2] - w[2], v_edges[0] - w_edges[0], v_edges[1] - w_edges[1], v_edges[2] - w_edges[2]};
  return quadratic_outflow(area, relative, of_corners);
}

}  // namespace

std::vector<double> cut_flows(const FluxStep& step, std::span<const distributed::CutElement> cuts, std::size_t count) {
  std::vector<double> flows(count, 0.0);
  for (const auto& cut : cuts) {
    const auto& region = step.mesh.regions[cut.region];
    const auto& nodes = region.elements[cut.element];
    const auto shape = present_shape(step, nodes);
    Vec3<double> slope{{0, 0, 0}};
    for (int a = 0; a < 4; ++a) slope = slope + cut.q[a] * shape.dN[a];
    flows[cut.cut] += dot(
        slope, step.mesh.quadratic ? carried_quadratic(step, region, cut.element, shape.volume) : carried(step, nodes));
  }
  parallel::global_sum(step.mesh.comm, flows);
  return flows;
}

PartBalance part_balance(const FluxStep& step, std::span<const double> q, std::span<const char> sticks) {
  double sums[4] = {};
  for (const auto& region : step.mesh.regions) {
    if (region.kind != RegionKind::lumen) continue;
    for (std::int32_t e = 0; e < region.owned_elements; ++e) {
      const auto& nodes = region.elements[e];
      const double mean = 0.25 * (q[nodes[0]] + q[nodes[1]] + q[nodes[2]] + q[nodes[3]]);
      if (mean == 0) continue;
      const auto shape = present_shape(step, nodes);
      double divergence = 0;
      for (int a = 0; a < 4; ++a) divergence += dot(shape.dN[a], vector_at(step.fields.mesh_velocity, nodes[a]));
      sums[0] += mean * shape.volume;
      sums[1] += mean * shape.volume * divergence;
    }
  }
  for (std::size_t f = 0; f < step.mesh.faces.size(); ++f) {
    const auto& face = step.mesh.faces[f];
    if (step.mesh.regions[face.region].kind != RegionKind::lumen) continue;
    for (std::int32_t t = 0; t < face.owned_triangles; ++t)
      sums[sticks[f] ? 3 : 2] += outflow(step, face, static_cast<std::size_t>(t), q);
  }
  parallel::global_sum(step.mesh.comm, sums);
  return {sums[0], sums[1], sums[2], sums[3]};
}

LumenRecord lumen_record(const FluxStep& step, const distributed::LumenMap& map) {
  LumenRecord record;
  record.tear_flows = cut_flows(step, map.cuts, map.tears.size());
  record.in_false = part_balance(step, map.in_false, map.sticks);
  record.residual = std::accumulate(record.tear_flows.begin(), record.tear_flows.end(), 0.0) - record.in_false.outflow -
                    record.in_false.leakage - record.in_false.volume_rate;
  for (const double flow : record.tear_flows) record.largest_flow = std::max(record.largest_flow, std::abs(flow));
  if (map.tears.empty())
    record.largest_flow = std::max(std::abs(record.in_false.outflow), std::abs(record.in_false.volume_rate));
  return record;
}

}  // namespace tunica::coupling
