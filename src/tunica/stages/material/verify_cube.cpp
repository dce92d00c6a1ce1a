#include "tunica/stages/material/verify_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/coupling/wall_element.hpp"
#include "tunica/distributed/distributed_mesh.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::stages {

namespace {

constexpr double edge = 1e-3;  // m

bc::Fixed held(bool x, bool y, bool z) {
  bc::Fixed fixed;
  fixed.directions = {x, y, z, false, false};
  return fixed;
}

coupling::ProblemInput cube_input(const CubeCase& c, wall::Element element) {
  const bool extension = c.loading == CubeLoading::extension;
  coupling::ProblemInput in;
  wall::Parameters& wall = in.wall.emplace();
  wall.element = element;
  wall.density = 1000.0;
  wall.material = c.material.parameters();
  wall.fibre_frame = wall::ConstantFrame{};
  in.boundary.wall_has_pressure = element == wall::Element::mixed;
  in.boundary.conditions = {{"x_min", bc::Free{}}, {"x_max", bc::Free{}},  {"y_min", bc::Free{}},
                            {"y_max", bc::Free{}}, {"z_min", bc::Fixed{}}, {"z_max", bc::Fixed{}}};
  if (extension) {
    in.boundary.conditions[0].second = held(true, false, false);
    in.boundary.conditions[2].second = held(false, true, false);
    in.boundary.conditions[4].second = in.boundary.conditions[5].second = held(false, false, true);
  }
  in.newton.relative_tolerance = 1e-9;
  in.newton.reference_fraction = 1e-12;
  in.newton.max_iterations = 30;
  in.newton.growth = 1e3;
  in.linear.tolerance = 1e-6;
  return in;
}

/// Moves the top, and in the extension all planes with it, so that no layer is squashed. In the shear the node in the
/// middle stays.
void prescribe(const distributed::DistributedMesh& mesh, const CubeCase& c, double load, coupling::State& state) {
  for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
    double* u = &state.displacement[4 * static_cast<std::size_t>(i)];
    const double z = mesh.points[i][2];
    if (c.loading == CubeLoading::extension)
      u[2] = (load - 1.0) * z;
    else if (z > 0.75 * edge)
      u[0] = load * z;
  }
}

/// The wanted stress of each element.
std::vector<double> element_stresses(const coupling::Problem& problem, const coupling::State& state, int component) {
  const distributed::DistributedMesh& mesh = problem.mesh();
  const coupling::WallModel& model = problem.wall_model();
  std::vector<double> stresses;
  for (std::size_t e = 0; e < mesh.regions[0].elements.size(); ++e) {
    const auto index = static_cast<std::int32_t>(e);
    const auto sigma = coupling::cauchy_stress(model, 0, index, coupling::wall_element(mesh, model, state, 0, index));
    stresses.push_back(sigma[component]);
  }
  return stresses;
}

}  // namespace

mesh::MeshData cube_of_32() {
  mesh::MeshData cube = mesh::box(2, 2, 1, {{edge, edge, edge}}, mesh::RegionKind::wall);
  const auto middle = static_cast<std::int64_t>(cube.points.size());
  cube.points.push_back({{0.5 * edge, 0.5 * edge, 0.5 * edge}});
  cube.tetrahedra.clear();
  for (const auto& face : cube.faces)
    for (const auto& [a, b, c] : face.triangles) cube.tetrahedra.push_back({middle, a, b, c});
  cube.regions[0].end_element = static_cast<std::int64_t>(cube.tetrahedra.size());
  return cube;
}

CubeSolution solve_cube(const CubeCase& c, wall::Element element) {
  const distributed::DistributedMesh mesh = distributed::distribute(cube_of_32(), MPI_COMM_SELF);
  coupling::Problem problem(mesh, cube_input(c, element));
  coupling::State state = problem.initial_state();
  CubeSolution solution;
  for (const double load : c.loads()) {
    prescribe(mesh, c, load, state);
    const coupling::StepReport report = problem.solve_static(state, 1.0);
    if (!report.converged) throw SolverError(fmt::format("cube, {}, load {:.4g}: {}", c.name(), load, report.failure));
    solution.newton_iterations += static_cast<int>(report.iterations.size());
    solution.linear_iterations += report.linear_iterations();
    solution.largest_residual = std::max(solution.largest_residual, report.final_norm / report.iterations.front().norm);
    const auto stresses = element_stresses(problem, state, c.loading == CubeLoading::extension ? 2 : 5);
    double mean = 0.0;
    for (const double s : stresses) mean += s / static_cast<double>(stresses.size());
    for (const double s : stresses) solution.scatter = std::max(solution.scatter, std::abs(s / mean - 1.0));
    solution.stresses.push_back(mean);
  }
  return solution;
}

}  // namespace tunica::stages
