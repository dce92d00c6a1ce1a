// Small tubes for the tests of the coupling: mesh, physics, and fields that every rank can compute.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tunica/coupling/problem.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"
#include "unit/assembly/numbers.hpp"

namespace tunica::wall {
enum class Element;
struct Parameters;  // wall/parameters.hpp
}  // namespace tunica::wall

namespace tunica::test {

inline mesh::TubeSizes tube_sizes(double wall_thickness) {
  return {.radius = 0.01,
          .length = 0.03,
          .wall_thickness = wall_thickness,
          .cells_around = 8,
          .cells_radial = 1,
          .cells_along = 4,
          .cells_through_wall = 2};
}
inline mesh::MeshData fluid_tube() { return mesh::tube(tube_sizes(0.0)); }
inline mesh::MeshData fsi_tube(bool quadratic = false) {
  auto data = mesh::tube(tube_sizes(0.002));
  if (quadratic) mesh::add_edge_nodes(data);
  return data;
}

inline fluid::Parameters blood() { return {.density = 1060, .viscosity = fluid::Newtonian{4e-3}}; }

wall::Parameters soft_wall(wall::Element element);

inline bc::Condition pressure(double value) { return bc::Pressure{bc::WaveformInput{value}}; }
inline bc::Condition fixed_along_axes(bool x, bool y, bool z) {
  bc::Fixed c;
  c.directions = {x, y, z, false, false};
  return c;
}
inline bc::Condition fixed_along_normal() {
  bc::Fixed c;
  c.directions = {false, false, false, true, false};
  return c;
}

/// Axes of turned_box().
inline std::array<Vec3<double>, 3> turned_axes() {
  const Vec3<double> e1{{0.36, 0.48, -0.8}}, e2{{-0.8, 0.6, 0.0}};
  return {e1, e2, cross(e1, e2)};
}

/// A box of 0.03 m x 0.02 m x 0.01 m that is turned, so that no plane of symmetry lies along an axis.
inline mesh::MeshData turned_box(bool quadratic) {
  auto data = mesh::box(3, 4, 2, {{0.03, 0.02, 0.01}}, mesh::RegionKind::lumen);
  const auto [e1, e2, e3] = turned_axes();
  for (auto& x : data.points) x = x[0] * e1 + x[1] * e2 + x[2] * e3;
  if (quadratic) mesh::add_edge_nodes(data);
  return data;
}

/// Half of a channel between planes of symmetry: the wall is y_max, the flow goes on to x_max.
inline coupling::BoundaryInput half_channel(bc::Condition inlet) {
  coupling::BoundaryInput in;
  in.fluid = blood();
  in.conditions = {{"x_min", std::move(inlet)}, {"x_max", pressure(0.0)},  {"y_min", bc::Symmetry{}},
                   {"y_max", bc::NoSlip{}},     {"z_min", bc::Symmetry{}}, {"z_max", bc::Symmetry{}}};
  return in;
}

/// Tube with a wall that is held at its ends: `inlet` and `outlet` are the conditions of the lumen's openings.
coupling::ProblemInput fsi_input(bc::Condition inlet, bc::Condition outlet);

/// Fields as a step would see them. Twins repeat the motion of their hosts.
struct Fields {
  std::vector<double> reference, position, velocity_pressure, acceleration, mesh_velocity, displacement;

  coupling::FieldsView view() const {
    return {.reference_position = reference.data(),
            .position = position.data(),
            .velocity_pressure = velocity_pressure.data(),
            .acceleration = acceleration.data(),
            .mesh_velocity = mesh_velocity.data(),
            .displacement = displacement.data()};
  }
};

/// Sizes of the random parts of the fields.
struct FieldSizes {
  double displacement = 5e-5, velocity = 0.1, pressure = 1e3, acceleration = 50;
};

inline Fields random_fields(const distributed::DistributedMesh& mesh, const FieldSizes& sizes = {}) {
  Fields f;
  const std::size_t n = at(mesh.nodes());
  for (auto* field :
       {&f.reference, &f.position, &f.velocity_pressure, &f.acceleration, &f.mesh_velocity, &f.displacement})
    field->assign(n, 0.0);
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const auto motion = mesh.original_ids[mesh.host[i]];
    for (int c = 0; c < 3; ++c) {
      const std::size_t k = at(i) + c;
      f.reference[k] = mesh.points[i][c];
      f.displacement[k] = sizes.displacement * noise(motion, c);
      f.position[k] = f.reference[k] + f.displacement[k];
      f.velocity_pressure[k] = sizes.velocity * noise(motion, 3 + c);
      f.acceleration[k] = sizes.acceleration * noise(motion, 6 + c);
      f.mesh_velocity[k] = sizes.velocity * noise(motion, 9 + c);
    }
    f.velocity_pressure[at(i) + 3] = sizes.pressure * noise(mesh.original_ids[i], 12);
  }
  return f;
}

/// Largest difference between owned nodes of `mesh` and the same nodes of a mesh on one rank, over the largest value
/// there; `begin`, `end`: components that are compared. Collective over mesh.comm.
inline double difference(const distributed::DistributedMesh& mesh, const std::vector<double>& values,
                         const distributed::DistributedMesh& whole, const std::vector<double>& whole_values, int begin,
                         int end) {
  std::vector<std::int32_t> local(static_cast<std::size_t>(whole.global_nodes));
  for (std::int32_t i = 0; i < whole.nodes(); ++i) local[static_cast<std::size_t>(whole.original_ids[i])] = i;
  double error = 0, size = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const auto j = local[static_cast<std::size_t>(mesh.original_ids[i])];
    for (int c = begin; c < end; ++c) error = std::max(error, std::abs(values[at(i) + c] - whole_values[at(j) + c]));
  }
  for (std::int32_t j = 0; j < whole.nodes(); ++j)
    for (int c = begin; c < end; ++c) size = std::max(size, std::abs(whole_values[at(j) + c]));
  return parallel::global_max(mesh.comm, error) / size;
}

}  // namespace tunica::test
