#include "tunica/artifacts/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "tunica/config/units.hpp"
#include "tunica/coupling/nodal.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/fe/quadratic_tetrahedron.hpp"
#include "tunica/field_io/array_name.hpp"
#include "tunica/fluid/boundary.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::artifacts {

namespace dimension = config::dimension;
using coupling::at;
using coupling::State;
using coupling::vector_at;
using field_io::array_name;
using mesh::RegionKind;

namespace {

std::array<std::int32_t, 3> sorted(std::array<std::int32_t, 3> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

const wall::LawParameters& material_of(const wall::Parameters& wall, const std::string& region) {
  const auto own = wall.regions.find(region);
  return own == wall.regions.end() ? wall.material : own->second.material;
}

}  // namespace

OutputFields::OutputFields(const coupling::Problem& problem, const case_file::Case& c)
    : problem_(problem),
      units_(c.output.units),
      dynamic_(!std::holds_alternative<case_file::StaticWall>(c.analysis)),
      at_end_(c.output.instant == case_file::Instant::end) {
  if (c.solves_fluid()) find_wall_triangles(c);
  const auto& regions = problem.mesh().regions;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (regions[r].kind != RegionKind::wall) continue;
    const auto n = static_cast<std::size_t>(regions[r].owned_elements);
    auto& stress = stress_.emplace_back(
        RegionStress{static_cast<std::int32_t>(r), std::vector<double>(n), std::vector<double>(n)});
    stress.fibres = wall::mean_fibre_directions(material_of(*problem.input().wall, regions[r].name));
    stress.fibre.assign(stress.fibres.size(), std::vector<double>(n));
  }
}

// The vessel's inside: interface faces and faces at which the flow sticks.
void OutputFields::find_wall_triangles(const case_file::Case& c) {
  const auto& mesh = problem_.mesh();
  std::set<std::string> inside;
  for (const auto& [lumen, wall] : problem_.input().boundary.interfaces) inside.insert(lumen);
  for (const auto& [face, condition] : c.boundary)
    if (std::holds_alternative<bc::NoSlip>(condition)) inside.insert(face);
  std::map<std::array<std::int32_t, 3>, std::size_t> wanted;
  for (const auto& face : mesh.faces) {
    if (!inside.contains(face.name)) continue;
    for (const auto& triangle : face.triangles) {
      wanted[sorted(triangle)] = wall_triangles_.size();
      wall_triangles_.push_back({triangle, {}, {}});
    }
  }
  for (const auto& region : mesh.regions) {
    if (region.kind != RegionKind::lumen) continue;
    for (std::size_t e = 0; e < region.elements.size(); ++e) {
      const auto& n = region.elements[e];
      for (const auto& side : {sorted({n[1], n[2], n[3]}), sorted({n[0], n[2], n[3]}), sorted({n[0], n[1], n[3]}),
                               sorted({n[0], n[1], n[2]})})
        if (const auto it = wanted.find(side); it != wanted.end()) {
          wall_triangles_[it->second].element = n;
          if (mesh.quadratic) wall_triangles_[it->second].edges = region.edges[e];
        }
    }
  }
}

// The gradient of a quadratic velocity at the six nodes of a triangle.
template <class Add>
void OutputFields::add_at_nodes(const WallTriangle& triangle, const fe::Gradients<double>& shape,
                                const double* velocity, Add add) const {
  const auto& corners = triangle.element;
  const auto on_triangle = [&](std::int32_t corner) {
    return std::find(triangle.nodes.begin(), triangle.nodes.end(), corner) != triangle.nodes.end();
  };
  const auto add_at = [&](std::int32_t node, const std::array<double, 4>& barycentric) {
    const auto point = fe::quadratic_point(barycentric, 1.0);
    Mat3<double> gradient{};
    for (int b = 0; b < fe::quadratic_nodes; ++b)
      fluid::detail::add_outer(gradient, vector_at(velocity, b < 4 ? corners[b] : triangle.edges[b - 4]),
                               fe::quadratic_gradient(shape.dN, point, b));
    add(node, gradient);
  };
  for (std::size_t a = 0; a < 4; ++a) {
    std::array<double, 4> l{};
    l[a] = 1.0;
    if (on_triangle(corners[a])) add_at(corners[a], l);
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const auto first = static_cast<std::size_t>(fe::edge_ends[e][0]),
               second = static_cast<std::size_t>(fe::edge_ends[e][1]);
    std::array<double, 4> l{};
    l[first] = l[second] = 0.5;
    if (on_triangle(corners[first]) && on_triangle(corners[second])) add_at(triangle.edges[e], l);
  }
}

// At a node the mean over its wall triangles, weighted with their areas. Every triangle at an owned node is present.
void OutputFields::compute_shear_stress(const State& state) {
  const auto& mesh = problem_.mesh();
  shear_.assign(3 * static_cast<std::size_t>(mesh.nodes()), 0.0);
  std::vector<double> weight(static_cast<std::size_t>(mesh.nodes()), 0.0);
  const auto position = [&](std::int32_t node) {
    return mesh.points[node] + vector_at(state.displacement.data(), node);
  };
  for (const auto& triangle : wall_triangles_) {
    Vec3<double> x[4], corners[3];
    for (int a = 0; a < 4; ++a) x[a] = position(triangle.element[a]);
    for (int a = 0; a < 3; ++a) corners[a] = position(triangle.nodes[a]);
    const auto shape = fe::gradients(x);
    const Vec3<double> n = fluid::area_vector(corners);
    const double area = norm(n);
    const auto add = [&](std::int32_t node, const Mat3<double>& gradient) {
      const double mu = std::visit([&](const auto& law) { return law.viscosity(fluid::shear_rate(gradient)); },
                                   problem_.input().fluid->viscosity);
      // What the flow does to the wall: the opposite of what the wall does to the flow.
      const Vec3<double> stress = (-1.0) * fluid::wall_shear_traction(gradient, mu, (1.0 / area) * n);
      weight[node] += area;
      for (int i = 0; i < 3; ++i) shear_[3 * static_cast<std::size_t>(node) + i] += area * stress[i];
    };
    if (mesh.quadratic) {
      add_at_nodes(triangle, shape, state.velocity_pressure.data(), add);
      continue;
    }
    Mat3<double> gradient{};
    for (int a = 0; a < 4; ++a)
      fluid::detail::add_outer(gradient, vector_at(state.velocity_pressure.data(), triangle.element[a]), shape.dN[a]);
    for (const auto node : triangle.nodes) add(node, gradient);
  }
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    for (int i = 0; i < 3 && weight[node] > 0; ++i) shear_[3 * static_cast<std::size_t>(node) + i] /= weight[node];
  mesh.halo.update(shear_, 3);
}

void OutputFields::compute_wall_stress(const coupling::FieldsView& fields) {
  const auto& mesh = problem_.mesh();
  const coupling::WallModel& model = problem_.wall_model();
  for (auto& stress : stress_) {
    const auto region = static_cast<std::size_t>(stress.region);
    for (std::size_t e = 0; e < stress.von_mises.size(); ++e) {
      const auto index = static_cast<std::int32_t>(e);
      const auto element = coupling::wall_element(mesh, model, fields, region, index);
      const auto sigma = coupling::cauchy_stress(model, region, index, element);
      stress.von_mises[e] = wall::von_mises(sigma);
      stress.principal[e] = wall::principal_stresses(sigma)[0];
      for (std::size_t f = 0; f < stress.fibres.size(); ++f)
        stress.fibre[f][e] = wall::fibre_stress(element, sigma, stress.fibres[f]);
    }
  }
}

void OutputFields::write(distributed::ResultsWriter& writer, std::int64_t step, double time, const State& state) {
  if (!at_end_) return write_instant(writer, step, time, state, problem_.fields_with_pressure(state));
  const State end = coupling::with_end_pressure(state);
  write_instant(writer, step, time, end,
                {.velocity_pressure = end.velocity_pressure.data(),
                 .acceleration = end.acceleration.data(),
                 .displacement = end.displacement.data()});
}

void OutputFields::write_instant(distributed::ResultsWriter& writer, std::int64_t step, double time, const State& state,
                                 const coupling::FieldsView& wall) {
  const auto& input = problem_.input();
  const auto per_si = [](const std::string& unit, const config::Dimension& d) {
    return 1 / config::unit_factor(unit, d);
  };
  const double stress_factor = per_si(units_.stress, dimension::pressure);
  std::vector<distributed::NodalArray> nodal;
  if (dynamic_)
    nodal.push_back({.name = array_name("velocity", units_.velocity),
                     .components = 3,
                     .values = state.velocity_pressure,
                     .stride = 4,
                     .factor = per_si(units_.velocity, dimension::velocity)});
  if (input.wall)
    nodal.push_back({.name = array_name("displacement", units_.length),
                     .components = 3,
                     .values = state.displacement,
                     .stride = 4,
                     .factor = per_si(units_.length, dimension::length)});
  const auto& regions = problem_.mesh().regions;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const bool lumen = regions[r].kind == RegionKind::lumen;
    if (lumen || input.wall->element == wall::Element::mixed)
      nodal.push_back({.name = array_name(lumen ? "pressure" : "wall pressure", units_.pressure),
                       .components = 1,
                       .values = std::span(state.velocity_pressure).subspan(state.velocity_pressure.empty() ? 0 : 3),
                       .stride = 4,
                       .factor = per_si(units_.pressure, dimension::pressure),
                       .region = static_cast<std::int32_t>(r)});
    if (!lumen) continue;
    compute_shear_stress(state);
    nodal.push_back({.name = array_name("wall shear stress", "Pa"),
                     .components = 3,
                     .values = shear_,
                     .stride = 3,
                     .region = static_cast<std::int32_t>(r)});
  }
  std::vector<distributed::CellArray> cells;
  if (input.wall) compute_wall_stress(wall);
  for (const auto& s : stress_) {
    cells.push_back({.name = array_name("von Mises stress", units_.stress),
                     .region = s.region,
                     .components = 1,
                     .values = s.von_mises,
                     .factor = stress_factor});
    cells.push_back({.name = array_name("first principal stress", units_.stress),
                     .region = s.region,
                     .components = 1,
                     .values = s.principal,
                     .factor = stress_factor});
    for (std::size_t f = 0; f < s.fibre.size(); ++f)
      cells.push_back({.name = array_name(fmt::format("stress along fibres {}", f + 1), units_.stress),
                       .region = s.region,
                       .components = 1,
                       .values = s.fibre[f],
                       .factor = stress_factor});
  }
  writer.write(step, time, nodal, cells);
}

}  // namespace tunica::artifacts
