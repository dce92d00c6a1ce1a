// What the verification of the wall shares: set-up, fields from functions, sums over elements.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tunica/coupling/problem.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/wall/output.hpp"

namespace tunica::verification {

using coupling::Problem;
using coupling::ProblemInput;
using coupling::State;
using wall::Element;
using wall::VolumetricEnergy;

inline std::size_t at(std::int32_t node) { return 4 * static_cast<std::size_t>(node); }

/// printf on rank 0.
[[gnu::format(printf, 1, 2)]] inline void print(const char* format, ...) {
  if (parallel::rank(MPI_COMM_WORLD) != 0) return;
  std::va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::fflush(stdout);
}

inline const char* name(Element element) { return element == Element::mixed ? "mixed" : "displacement"; }

struct SolidCase {
  Element element = Element::mixed;
  double shear_modulus = 1.0;  ///< Pa
  double poisson_ratio = 0.5;
  double density = 1000.0;  ///< kg/m^3
  VolumetricEnergy energy = VolumetricEnergy::simo_taylor;
};

/// Wall alone, with tolerances that leave the discretisation error only.
inline ProblemInput solid_input(const SolidCase& c, std::vector<std::pair<std::string, bc::Condition>> conditions) {
  ProblemInput in;
  in.wall = wall::Parameters{};
  in.wall->element = c.element;
  in.wall->density = c.density;
  in.wall->volumetric_energy = c.energy;
  auto& elastic = std::get<0>(in.wall->material).elastic;
  elastic.shear_modulus = c.shear_modulus;
  elastic.poisson_ratio = c.poisson_ratio;
  in.boundary.wall_has_pressure = c.element == Element::mixed;
  in.boundary.conditions = std::move(conditions);
  in.newton.relative_tolerance = 1e-9;
  in.newton.reference_fraction = 1e-12;
  in.newton.max_iterations = 30;
  in.newton.growth = 1e3;
  in.linear.tolerance = in.linear.first_tolerance = 1e-6;
  return in;
}

inline bc::Fixed held(bool x, bool y, bool z) {
  bc::Fixed fixed;
  fixed.directions = {x, y, z, false, false};
  return fixed;
}

enum class Order { linear, quadratic };
inline const char* name(Order order) { return order == Order::linear ? "linear" : "quadratic"; }

inline distributed::DistributedMesh share(mesh::MeshData data, Order order = Order::linear) {
  if (order == Order::quadratic) mesh::add_edge_nodes(data);
  return distributed::distribute(parallel::rank(MPI_COMM_WORLD) == 0 ? data : mesh::MeshData{}, MPI_COMM_WORLD);
}

/// u(X) at every node. Where the boundary is held it stays, so this prescribes boundary displacements in statics.
template <class Function>
void set_displacement(const distributed::DistributedMesh& mesh, State& state, const Function& u) {
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    const Vec3<double> value = u(mesh.points[i]);
    for (int c = 0; c < 3; ++c) state.displacement[at(i) + c] = value[c];
  }
}

/// Largest of value(node) over all owned nodes of all ranks.
template <class Function>
double largest(const distributed::DistributedMesh& mesh, const Function& value) {
  double result = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) result = std::max(result, value(i));
  return parallel::global_max(mesh.comm, result);
}

struct ElementData {
  Vec3<double> X[4];
  std::array<std::int32_t, 4> nodes;
  wall::ElementState<double> state;  ///< gradients in the fibre frame, if the law has one
  std::size_t region;
  std::int32_t element;
};

inline ElementData gather(const distributed::DistributedMesh& mesh, const coupling::WallModel& model,
                          const State& state, std::size_t region, std::int32_t element) {
  ElementData e;
  e.nodes = mesh.regions[region].elements[element];
  for (int a = 0; a < 4; ++a) e.X[a] = mesh.points[e.nodes[a]];
  e.state = coupling::wall_element(mesh, model, state, region, element);
  e.region = region, e.element = element;
  return e;
}

/// Calls visit(ElementData) for the wall elements that this rank counts.
template <class Visit>
void for_each_element(const distributed::DistributedMesh& mesh, const coupling::WallModel& model, const State& state,
                      const Visit& visit) {
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    if (mesh.regions[r].kind == mesh::RegionKind::wall)
      for (std::int32_t k = 0; k < mesh.regions[r].owned_elements; ++k) visit(gather(mesh, model, state, r, k));
}

inline Mat3<double> cauchy_stress(const ElementData& e, const coupling::WallModel& model) {
  const auto s = coupling::cauchy_stress(model, e.region, e.element, e.state);
  return {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
}

/// Takes the load factor to one in `steps` steps, each starting from the last; returns the last report.
inline coupling::StepReport load(Problem& problem, State& state, int steps) {
  coupling::StepReport report;
  for (int k = 1; k <= steps; ++k) {
    report = problem.solve_static(state, static_cast<double>(k) / steps);
    EXPECT_TRUE(report.converged) << report.failure;
    if (!report.converged) break;
  }
  return report;
}

}  // namespace tunica::verification
