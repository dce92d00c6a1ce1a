#include "tunica/coupling/monitors.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/fluid/energy.hpp"
#include "tunica/fluid/taylor_hood.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/wall/quadratic_output.hpp"

namespace tunica::coupling {

using mesh::RegionKind;

namespace {

bool blood_sticks(const BoundaryInput& boundary, const std::string& face) {
  return std::any_of(boundary.interfaces.begin(), boundary.interfaces.end(),
                     [&](const auto& pair) { return pair.first == face; }) ||
         std::any_of(boundary.conditions.begin(), boundary.conditions.end(),
                     [&](const auto& c) { return c.first == face && std::holds_alternative<bc::NoSlip>(c.second); });
}

double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

// The interface carries no load of its own; on its rim the conditions of the adjoining faces act as well.
Monitors::Monitors(const Problem& problem) : problem_(problem), kind_(problem.mesh().owned_nodes, NodeKind::inner) {
  const auto& mesh = problem.mesh();
  for (const auto& region : mesh.regions)
    if (region.kind == RegionKind::wall)
      distributed::for_each_node(region, [&](std::int32_t node) {
        if (node < mesh.owned_nodes) kind_[node] = NodeKind::wall;
      });
  std::set<std::string> interface;
  for (const auto& [lumen, wall] : problem.input().boundary.interfaces) interface.insert({lumen, wall});
  std::vector<char> on_interface(kind_.size(), 0), on_other(kind_.size(), 0);
  for (const auto& face : mesh.faces) {
    auto& mark = interface.contains(face.name) ? on_interface : on_other;
    for (const auto& triangle : face.triangles)
      for (const auto node : triangle)
        if (mesh.host[node] < mesh.owned_nodes) mark[mesh.host[node]] = 1;
    for (const auto& edges : face.edges)
      for (const auto node : edges)
        if (mesh.host[node] < mesh.owned_nodes) mark[mesh.host[node]] = 1;
  }
  for (std::size_t i = 0; i < kind_.size(); ++i) {
    if (on_interface[i])
      kind_[i] = on_other[i] ? NodeKind::rim : NodeKind::interface;
    else if (on_other[i] && kind_[i] == NodeKind::inner)
      kind_[i] = NodeKind::opening;
  }
  find_sticking_faces();
}

void Monitors::find_sticking_faces() {
  const auto& mesh = problem_.mesh();
  std::vector<int> faces_of(static_cast<std::size_t>(mesh.owned_nodes), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    if (!blood_sticks(problem_.input().boundary, face.name) || mesh.regions[face.region].kind != RegionKind::lumen)
      continue;
    std::set<std::int32_t> nodes;
    for (const auto* cells : {&face.triangles, &face.edges})
      for (const auto& cell : *cells)
        for (const auto node : cell)
          if (node < mesh.owned_nodes) nodes.insert(node);
    auto& sticking = sticking_.emplace_back(StickingFace{f, {}});
    for (const auto node : nodes) {
      sticking.nodes.emplace_back(node, 1.0);
      ++faces_of[node];
    }
  }
  for (auto& face : sticking_)
    for (auto& [node, share] : face.nodes) share = 1.0 / faces_of[node];
}

std::vector<std::pair<std::string, Monitors::FaceSums>> Monitors::face_sums(const FieldsView& f) const {
  const auto& mesh = problem_.mesh();
  std::vector<std::string> names;
  std::vector<double> sums;
  for (const auto& face : mesh.faces) {
    if (mesh.regions[face.region].kind != RegionKind::lumen) continue;
    double flow = 0, force = 0, area = 0, sweep = 0;
    for (std::int32_t t = 0; t < face.owned_triangles; ++t) {
      Vec3<double> x[3], v[3], w[3];
      // The integral of a quadratic function is the mean of its values on the edges.
      const auto& nodes = mesh.quadratic ? face.edges[t] : face.triangles[t];
      gather(f.position, face.triangles[t], x);
      gather(f.velocity_pressure, nodes, v);
      gather(f.mesh_velocity, nodes, w);
      double p[3];
      for (int a = 0; a < 3; ++a) p[a] = f.velocity_pressure[at(face.triangles[t][a]) + 3];
      flow += fluid::flow(x, v, w);
      force += fluid::integrated_pressure(x, p);
      area += fluid::area(x);
      sweep += dot(fluid::nodal_area_vector(x), w[0] + w[1] + w[2]);
    }
    names.push_back(face.name);
    sums.insert(sums.end(), {flow, force, area, sweep});
  }
  parallel::global_sum(mesh.comm, sums);
  std::vector<std::pair<std::string, FaceSums>> faces;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double* sum = sums.data() + 4 * k;
    faces.emplace_back(names[k], FaceSums{sum[0], sum[1], sum[2], sum[3]});
  }
  return faces;
}

void Monitors::faces(StepRecord& record) const {
  for (const auto& [name, sums] : face_sums(problem_.fields())) {
    record.faces.push_back(sums.record(name));
    record.volume_rate += sums.sweep;
    record.mass_residual += sums.flow;
    record.largest_flow = std::max(record.largest_flow, std::abs(sums.flow));
  }
  for (const auto& prescribed : problem_.prescribed_flows())
    for (auto& face : record.faces)
      if (face.name == problem_.mesh().faces[prescribed.face].name) face.prescribed = prescribed.outward;
  record.mass_residual += record.volume_rate;
  record.largest_flow = std::max(record.largest_flow, std::abs(record.volume_rate));
}

std::vector<FaceRecord> Monitors::faces_at_end(const State& state) const {
  const State end = with_end_pressure(state);
  std::vector<double> position = end.displacement;
  for (std::int32_t i = 0; i < problem_.mesh().nodes(); ++i)
    for (int c = 0; c < 3; ++c) position[at(i) + static_cast<std::size_t>(c)] += problem_.mesh().points[i][c];
  const FieldsView fields{.position = position.data(),
                          .velocity_pressure = end.velocity_pressure.data(),
                          .mesh_velocity = end.displacement_rate.data()};
  std::vector<FaceRecord> faces;
  for (const auto& [name, sums] : face_sums(fields)) faces.push_back(sums.record(name));
  return faces;
}

/// Of one element of the lumen.
struct Monitors::Power {
  double volume, kinetic, viscous, numerical;  ///< m^3, J, W, W
};

Monitors::Power Monitors::quadratic_power(const distributed::Region& region, std::int32_t element) const {
  namespace th = fluid::taylor_hood;
  const FieldsView f = problem_.fields();
  const fluid::Parameters& parameters = *problem_.input().fluid;
  const auto& corners = region.elements[element];
  const auto nodes = distributed::quadratic_nodes(region, static_cast<std::size_t>(element));
  th::ElementState<double> s;
  gather(f.position, corners, s.position);
  gather(f.velocity_pressure, nodes, s.velocity);
  gather(f.acceleration, nodes, s.acceleration);
  gather(f.mesh_velocity, corners, s.mesh_velocity);
  gather(f.stream, nodes, s.stream);
  gather(f.convection, nodes, s.convection);
  for (int a = 0; a < 10; ++a) s.rate_squared[a] = f.stream[at(nodes[a]) + 3];
  for (int a = 0; a < 4; ++a) s.pressure[a] = f.velocity_pressure[at(corners[a]) + 3];
  const auto energy = std::visit(
      [&](const auto& law) {
        return th::energy(s, {0.0, 0.0, problem_.flow_speed()}, parameters, law);
      },
      parameters.viscosity);
  return {energy.volume, energy.kinetic, energy.viscous, energy.numerical};
}

Monitors::Power Monitors::linear_power(const distributed::Region& region, std::int32_t element, double dt) const {
  const FieldsView f = problem_.fields();
  const fluid::Parameters& parameters = *problem_.input().fluid;
  const auto& nodes = region.elements[element];
  fluid::ElementState<double> s;
  gather(f.position, nodes, s.position);
  gather(f.velocity_pressure, nodes, s.velocity);
  gather(f.acceleration, nodes, s.acceleration);
  gather(f.mesh_velocity, nodes, s.mesh_velocity);
  for (int a = 0; a < 4; ++a) s.pressure[a] = f.velocity_pressure[at(nodes[a]) + 3];
  const auto flow = std::visit([&](const auto& law) { return fluid::evaluate(s, law); }, parameters.viscosity);
  const auto tau = fluid::stabilisation(flow, dt, parameters);
  return {flow.shape.volume, fluid::kinetic_energy(flow.shape.volume, s.velocity, parameters.density),
          fluid::viscous_dissipation(flow), fluid::numerical_dissipation(flow, tau, s.velocity, parameters.density)};
}

void Monitors::lumen_elements(double dt, StepRecord& record) const {
  const auto& mesh = problem_.mesh();
  const distributed::LumenMap& map = problem_.input().lumens;
  const std::size_t parts = std::max<std::size_t>(1, map.parts.size());
  std::vector<double> sums(2 + 2 * parts, 0.0);  // volume, kinetic energy; viscous and numerical dissipation of a part
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const auto& region = mesh.regions[r];
    if (region.kind != RegionKind::lumen) continue;
    for (std::int32_t e = 0; e < region.owned_elements; ++e) {
      const Power power = mesh.quadratic ? quadratic_power(region, e) : linear_power(region, e, dt);
      const std::size_t part = map.parts.empty() ? 0 : static_cast<std::size_t>(map.part_of[r][e]);
      sums[0] += power.volume;
      sums[1] += power.kinetic;
      sums[2 + 2 * part] += power.viscous;
      sums[3 + 2 * part] += power.numerical;
    }
  }
  parallel::global_sum(mesh.comm, sums);
  record.lumen_volume = sums[0];
  record.fluid_kinetic = sums[1];
  if (!map.empty()) record.lumens.emplace();
  for (std::size_t part = 0; part < parts; ++part) {
    record.viscous_dissipation += sums[2 + 2 * part];
    record.numerical_dissipation += sums[3 + 2 * part];
    if (!record.lumens) continue;
    record.lumens->viscous.push_back(sums[2 + 2 * part]);
    record.lumens->numerical.push_back(sums[3 + 2 * part]);
  }
}

void Monitors::lumens(double dt, StepRecord& record) const {
  LumenRecord lumens =
      lumen_record({problem_.mesh(), problem_.fields(), *problem_.input().fluid, dt}, problem_.input().lumens);
  lumens.true_volume = record.lumen_volume - lumens.in_false.volume;
  lumens.viscous = std::move(record.lumens->viscous);
  lumens.numerical = std::move(record.lumens->numerical);
  record.lumens = std::move(lumens);
}

void Monitors::quadratic_wall_elements(std::size_t index, double (&sums)[3]) const {
  namespace wq = wall::quadratic;
  const auto& mesh = problem_.mesh();
  const auto& region = mesh.regions[index];
  const FieldsView f = problem_.fields();
  const WallModel& model = problem_.wall_model();
  for (std::int32_t e = 0; e < region.owned_elements; ++e) {
    const auto s = quadratic_wall_element(mesh, model, f, index, e);
    Vec3<double> velocity[wq::nodes];
    gather(f.velocity_pressure, distributed::quadratic_nodes(region, static_cast<std::size_t>(e)), velocity);
    const auto [law, body] = model.material(index, e);
    const auto prestress = model.point_prestress(index, e);
    sums[0] += wq::present_volume(s);
    sums[1] += wq::kinetic_energy(wq::stress_free_volume(s, prestress), velocity, body.density);
    sums[2] += model.mixed() ? wq::strain_energy<true>(s, law, body, prestress)
                             : wq::strain_energy<false>(s, law, body, prestress);
  }
}

void Monitors::wall_elements(StepRecord& record) const {
  const auto& mesh = problem_.mesh();
  const FieldsView f = problem_.fields();
  double sums[3] = {};  // volume, kinetic energy, strain energy
  const WallModel& model = problem_.wall_model();
  for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
    const auto& region = mesh.regions[i];
    if (region.kind != RegionKind::wall) continue;
    if (mesh.quadratic) {
      quadratic_wall_elements(i, sums);
      continue;
    }
    for (std::int32_t e = 0; e < region.owned_elements; ++e) {
      const auto& nodes = region.elements[e];
      Vec3<double> X[4], velocity[4], x[4];
      gather(f.reference_position, nodes, X);
      gather(f.velocity_pressure, nodes, velocity);
      wall::ElementState<double> s = model.at_rest(i, e, X);
      gather(f.displacement, nodes, s.displacement);
      for (int a = 0; a < 4; ++a) {
        s.pressure[a] = f.velocity_pressure[at(nodes[a]) + 3];
        x[a] = X[a] + s.displacement[a];
      }
      const auto [law, body] = model.material(i, e);
      sums[0] += fe::gradients(x).volume;
      sums[1] += wall::kinetic_energy(s.reference.volume, velocity, body.density);
      sums[2] +=
          model.mixed() ? wall::mixed_strain_energy(s, law, body) : wall::displacement_strain_energy(s, law, body);
      if (model.prestress().kind == wall::PrestressKind::stress)
        sums[2] += wall::prestress_energy(s, model.prestress(i, e, 0));
    }
  }
  parallel::global_sum(mesh.comm, sums);
  record.wall_volume = sums[0];
  record.wall_kinetic = sums[1];
  record.wall_strain = sums[2];
}

// The residual of the elements at a node is the force that acts on them there.
void Monitors::powers(const Problem::PartialResiduals& parts, StepRecord& record) const {
  const double* v = problem_.fields().velocity_pressure;
  double sums[4] = {};  // openings, wall loads, interface lumen, interface wall
  for (std::size_t i = 0; i < kind_.size(); ++i) {
    const double lumen = dot3(v + 4 * i, parts.lumen.data() + 4 * i), wall = dot3(v + 4 * i, parts.wall.data() + 4 * i);
    switch (kind_[i]) {
      case NodeKind::opening:
        sums[0] += lumen;
        break;
      case NodeKind::wall:
        sums[1] += wall;
        break;
      case NodeKind::rim:
        sums[1] += lumen + wall;
        break;
      case NodeKind::interface:
        sums[2] += lumen, sums[3] += wall;
        break;
      case NodeKind::inner:
        break;
    }
  }
  parallel::global_sum(problem_.mesh().comm, sums);
  record.opening_power = sums[0];
  record.wall_load_power = sums[1];
  record.interface_power_lumen = sums[2];
  record.interface_power_wall = sums[3];
}

void Monitors::wall_forces(const Problem::PartialResiduals& parts, StepRecord& record) const {
  std::vector<double> sums;
  for (const auto& face : sticking_) {
    double force[3] = {};
    for (const auto& [node, share] : face.nodes)
      for (std::size_t c = 0; c < 3; ++c) force[c] -= share * parts.lumen[at(node) + c];
    sums.insert(sums.end(), force, force + 3);
  }
  parallel::global_sum(problem_.mesh().comm, sums);
  for (std::size_t k = 0; k < sticking_.size(); ++k)
    record.wall_forces.push_back(
        {problem_.mesh().faces[sticking_[k].face].name, {{sums[3 * k], sums[3 * k + 1], sums[3 * k + 2]}}});
}

void Monitors::extremes(StepRecord& record) const {
  const auto& mesh = problem_.mesh();
  const FieldsView f = problem_.fields();
  double u = 0, v = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    u = std::max(u, dot3(f.displacement + at(i), f.displacement + at(i)));
    v = std::max(v, dot3(f.velocity_pressure + at(i), f.velocity_pressure + at(i)));
  }
  record.max_displacement = std::sqrt(parallel::global_max(mesh.comm, u));
  record.max_velocity = std::sqrt(parallel::global_max(mesh.comm, v));
  if (problem_.moving()) record.mesh_quality = mesh_quality(mesh, std::span(f.position, at(mesh.nodes()))).smallest;
}

StepRecord Monitors::evaluate(double dt) const {
  StepRecord record;
  faces(record);
  if (problem_.input().fluid) lumen_elements(dt, record);
  if (record.lumens) lumens(dt, record);
  if (problem_.input().wall) wall_elements(record);
  if (dt > 0) {
    const auto parts = problem_.partial_residuals();
    powers(parts, record);
    wall_forces(parts, record);
  }
  extremes(record);
  return record;
}

}  // namespace tunica::coupling
