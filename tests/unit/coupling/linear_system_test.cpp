// Solver and preconditioner on the tangent of a small tube, and the tangent itself against differences of the residual.
#include <gtest/gtest.h>

#include <cmath>

#include "small_cases.hpp"
#include "tunica/assembly/linear_solver.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/wall/parameters.hpp"

namespace tunica::coupling {
namespace {

using assembly::RankOne;
using test::at;
using test::noise;

// Residual and tangent as in a time step, with the lumen mesh held where the fields have it.
struct FsiSystem {
  distributed::DistributedMesh mesh;
  ProblemInput input;
  assembly::Isa isa = assembly::choose_isa();
  assembly::BlockPattern pattern = assembly::make_pattern(mesh);
  Boundaries boundaries{mesh, pattern, input.boundary};
  WallModel wall{mesh, *input.wall};
  assembly::TimeScheme scheme = assembly::TimeScheme::generalised_alpha(1e-4, 0.5);
  assembly::BlockMatrix matrix{pattern};

  explicit FsiSystem(MPI_Comm comm)
      : mesh(distributed::distribute(test::fsi_tube(), comm)),
        input(test::fsi_input(test::pressure(1e3), test::pressure(0.0))) {}

  std::vector<double> assemble(const test::Fields& fields, assembly::BlockMatrix* tangent) const {
    std::vector<double> residual(at(mesh.nodes()), 0.0);
    const LoopTarget target{residual.data(), tangent == nullptr ? nullptr : tangent->blocks.data()->a};
    const auto& s = scheme;
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      const int width = static_cast<int>(isa);
      if (mesh.regions[r].kind == mesh::RegionKind::lumen) {
        const auto batches = assembly::make_batches(mesh, mesh.regions[r], pattern, width, false);
        element_loops(isa).fluid({BatchView(batches)}, fields.view(), *input.fluid,
                                 {s.dt, s.acceleration_per_unknown(), s.velocity_per_unknown()}, {}, target);
        continue;
      }
      for (const auto& group : wall.groups(mesh, r, pattern, width))
        element_loops(isa).wall.assemble(group.view(), fields.view(), wall.element_settings(),
                                         {s.acceleration_per_unknown(), s.displacement_per_unknown(),
                                          s.velocity_per_unknown() / s.displacement_per_unknown()},
                                         target);
    }
    boundaries.loads().add(0.0, 1.0, fields.view(), {s.velocity_per_unknown(), s.displacement_per_unknown()}, residual,
                         tangent);
    return residual;
  }
  void assemble_tangent() {
    assemble(test::random_fields(mesh, {.displacement = 2e-5, .velocity = 0.05}), &matrix);
    boundaries.constraints().apply(matrix);
  }
  // A x, entry by entry.
  std::vector<double> product(const std::vector<double>& x) const {
    std::vector<double> y(at(mesh.owned_nodes), 0.0);
    for (std::int32_t row = 0; row < pattern.rows; ++row)
      for (auto b = pattern.row_begin[row]; b < pattern.row_begin[row + 1]; ++b)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            y[at(row) + i] += static_cast<double>(matrix.blocks[b].a[4 * j + i]) * x[at(pattern.columns[b]) + j];
    return y;
  }
  // Random, in the range of the constraints, each entry as large as its equation.
  std::vector<double> right_hand_side(const std::vector<double>& scale) const {
    std::vector<double> b(at(mesh.nodes()), 0.0);
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      for (int c = 0; c < 4; ++c) b[at(i) + c] = scale[at(i) + c] * noise(mesh.original_ids[i], 20 + c);
    boundaries.constraints().apply(b);
    b.resize(at(mesh.owned_nodes));
    return b;
  }
  // Area vectors of a face's owned nodes, projected on their free motions; `half`: of those with x > 0 only.
  RankOne outlet(const std::string& name, double coefficient, bool half) const {
    std::vector<double> s(at(mesh.nodes()), 0.0);
    for (const auto& triangle : mesh.face(name).triangles) {
      const Vec3<double> x[3] = {mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]};
      const auto area = fluid_area(x);
      for (const auto node : triangle)
        for (int c = 0; c < 3; ++c) s[at(node) + c] += area[c] / 3.0;
    }
    boundaries.constraints().apply(s);
    RankOne term{.coefficient = coefficient, .nodes = {}, .s = {}};
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      if (s[at(i) + 2] == 0.0 || (half && mesh.points[i][0] <= 0)) continue;
      term.nodes.push_back(i);
      term.s.push_back({s[at(i)], s[at(i) + 1], s[at(i) + 2]});
    }
    return term;
  }
  static Vec3<double> fluid_area(const Vec3<double> (&x)[3]) { return 0.5 * cross(x[1] - x[0], x[2] - x[0]); }

  std::vector<RankOne> outlets(int count) const {
    std::vector<RankOne> list;
    if (count > 0) list.push_back(outlet("lumen_outlet", 3e9, false));
    if (count > 1) list.push_back(outlet("lumen_inlet", 1e10, false));
    if (count > 2) list.push_back(outlet("lumen_outlet", 2e9, true));
    return list;
  }
};

struct Solution {
  assembly::LinearResult result;
  double true_residual;
  std::vector<double> x;
};

Solution solve(FsiSystem& system, int outlet_count, double tolerance) {
  assembly::SchurPreconditioner preconditioner(system.mesh, system.pattern, system.isa);
  preconditioner.update(system.matrix, {});
  const auto b = system.right_hand_side(preconditioner.scale());
  const auto outlets = system.outlets(outlet_count);
  assembly::LinearSolver solver(system.mesh, system.pattern, system.isa, {.tolerance = tolerance});
  solver.update_preconditioner(system.matrix, outlets);
  Solution s{{}, 0.0, std::vector<double>(at(system.mesh.nodes()))};
  s.result = solver.solve(system.matrix, outlets, b, s.x, 0.0);

  auto r = system.product(s.x);
  for (const auto& term : outlets) {
    double flow = 0;
    for (std::size_t k = 0; k < term.nodes.size(); ++k)
      for (int c = 0; c < 3; ++c) flow += term.s[k][c] * s.x[at(term.nodes[k]) + c];
    flow = parallel::global_sum(system.mesh.comm, flow);
    for (std::size_t k = 0; k < term.nodes.size(); ++k)
      for (int c = 0; c < 3; ++c) r[at(term.nodes[k]) + c] += term.coefficient * flow * term.s[k][c];
  }
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = b[k] - r[k];
  s.true_residual = solver.norm(r) / solver.norm(b);
  return s;
}

TEST(LinearSystem, SolutionHasTheResidualAskedForWithAndWithoutOutlets) {
  FsiSystem system(MPI_COMM_WORLD);
  system.assemble_tangent();
  int without = 0;
  for (const int outlets : {0, 1, 3}) {
    SCOPED_TRACE(outlets);
    const auto s = solve(system, outlets, 1e-5);
    EXPECT_TRUE(s.result.converged);
    // The preconditioner is linear to single precision only, which the last application of GMRES adds to the residual.
    EXPECT_LE(s.true_residual, 1e-5 + 1e-6);
    EXPECT_NEAR(s.result.residual, s.true_residual, 1e-6);
    if (outlets == 0) without = s.result.iterations;
    EXPECT_LE(s.result.iterations, without + 1) << "outlets cost iterations";
    RecordProperty("iterations_" + std::to_string(outlets), s.result.iterations);
  }
  EXPECT_LE(without, 60) << "iterations without outlets";
}

// Undamped, the incomplete factors of a compliant wall next to blood amplify some vectors: 88 iterations.
TEST(LinearSystem, LargeStepOfACompliantTubeTakesFewIterations) {
  const auto data = mesh::tube({.radius = 0.01,
                                .length = 0.1,
                                .wall_thickness = 0.002,
                                .cells_around = 16,
                                .cells_radial = 2,
                                .cells_along = 16,
                                .cells_through_wall = 1});
  const auto mesh = distributed::distribute(data, MPI_COMM_WORLD);
  ProblemInput input = test::fsi_input(test::pressure(10.0), test::pressure(0.0));
  wall::NeoHookeParameters law;
  law.elastic.young_modulus = 400e3;
  law.elastic.poisson_ratio = 0.49;
  input.wall->material = law;
  input.rho_infinity = 0.2;
  Problem problem(mesh, input);
  auto state = problem.initial_state();
  const auto report = problem.advance(state, 5e-3);
  EXPECT_TRUE(report.converged) << report.failure;
  EXPECT_LE(report.linear_iterations(), 70);
  RecordProperty("iterations", report.linear_iterations());
}

TEST(LinearSystem, SolutionIsTheSameOnAnyNumberOfRanks) {
  FsiSystem system(MPI_COMM_WORLD), whole(MPI_COMM_SELF);
  system.assemble_tangent();
  whole.assemble_tangent();
  const auto parts = solve(system, 3, 1e-10), one = solve(whole, 3, 1e-10);
  EXPECT_LE(test::difference(system.mesh, parts.x, whole.mesh, one.x, 0, 3), 1e-5);
  EXPECT_LE(test::difference(system.mesh, parts.x, whole.mesh, one.x, 3, 4), 1e-5);
}

TEST(LinearSystem, GhostsOfTheSolutionAreUpToDate) {
  FsiSystem system(MPI_COMM_WORLD);
  system.assemble_tangent();
  const auto s = solve(system, 1, 1e-4);
  auto updated = s.x;
  system.mesh.halo.update(updated, 4);
  EXPECT_EQ(s.x, updated);
}

TEST(LinearSystem, PreconditionerIsLinearAndRepeatable) {
  FsiSystem system(MPI_COMM_WORLD);
  system.assemble_tangent();
  assembly::SchurPreconditioner preconditioner(system.mesh, system.pattern, system.isa);
  preconditioner.update(system.matrix, {});
  const std::size_t n = at(system.mesh.owned_nodes);
  const auto& d = preconditioner.scale();
  std::vector<double> r1(n), r2(n), both(n), z1(n), z2(n), again(n), z(n);
  for (std::size_t k = 0; k < n; ++k) {
    r1[k] = d[k] * noise(system.mesh.original_ids[k / 4], 30 + static_cast<int>(k % 4));
    r2[k] = d[k] * noise(system.mesh.original_ids[k / 4], 34 + static_cast<int>(k % 4));
    both[k] = 2.0 * r1[k] - 3.0 * r2[k];
  }
  preconditioner.apply(r1, z1);
  preconditioner.apply(r2, z2);
  preconditioner.apply(both, z);
  preconditioner.apply(r1, again);
  EXPECT_EQ(z1, again);
  double error = 0, size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    error = std::max(error, d[k] * std::abs(z[k] - 2.0 * z1[k] + 3.0 * z2[k]));
    size = std::max(size, d[k] * std::abs(z[k]));
  }
  EXPECT_LE(parallel::global_max(MPI_COMM_WORLD, error), 1e-5 * parallel::global_max(MPI_COMM_WORLD, size));
  preconditioner.update(system.matrix, {});  // a new set-up from the same matrix
  preconditioner.apply(r1, again);
  EXPECT_EQ(z1, again);
}

// The stabilisation parameters of the flow are held in its tangent; at so small a velocity they hardly vary.
TEST(LinearSystem, TangentIsTheDerivativeOfTheResidual) {
  FsiSystem system(MPI_COMM_WORLD);
  const auto& mesh = system.mesh;
  const auto fields = test::random_fields(mesh, {.velocity = 1e-3, .pressure = 10, .acceleration = 0.2});
  system.assemble(fields, &system.matrix);
  for (const int component : {0, 10}) {
    SCOPED_TRACE(component);
    std::vector<double> direction(at(mesh.nodes()), 0.0);  // twins have no motion of their own
    for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
      for (int c = 0; c < 3 && mesh.host[i] == i; ++c)
        direction[at(i) + c] = 1e-2 * noise(mesh.original_ids[i], 50 + component + c);
      direction[at(i) + 3] = 1e2 * noise(mesh.original_ids[i], 53 + component);
    }
    const auto moved = [&](double step) {
      auto f = fields;
      for (std::int32_t i = 0; i < mesh.nodes(); ++i) {
        for (int c = 0; c < 3; ++c) {
          const double d = step * direction[at(mesh.host[i]) + c];
          f.velocity_pressure[at(i) + c] += system.scheme.velocity_per_unknown() * d;
          f.acceleration[at(i) + c] += system.scheme.acceleration_per_unknown() * d;
          f.displacement[at(i) + c] += system.scheme.displacement_per_unknown() * d;
        }
        f.velocity_pressure[at(i) + 3] += step * direction[at(i) + 3];
      }
      return system.assemble(f, nullptr);
    };
    const auto product = system.product(direction);
    std::vector<char> is_wall(mesh.nodes(), 0);
    for (const auto& region : mesh.regions)
      for (const auto& element : region.elements)
        for (const auto node : element) is_wall[node] = region.kind == mesh::RegionKind::wall;
    // Rows: momentum and continuity of the flow, momentum and constraint of the wall.
    const double step = 1e-3;
    const auto plus = moved(step), minus = moved(-step);
    double errors[4] = {}, sizes[4] = {};
    for (std::size_t k = 0; k < product.size(); ++k) {
      const std::size_t group = (is_wall[k / 4] ? 2 : 0) + (k % 4 < 3 ? 0 : 1);
      errors[group] += std::pow((plus[k] - minus[k]) / (2.0 * step) - product[k], 2);
      sizes[group] += product[k] * product[k];
    }
    parallel::global_sum(MPI_COMM_WORLD, errors);
    parallel::global_sum(MPI_COMM_WORLD, sizes);
    const double tolerance[4] = {1e-5, 1e-6, 1e-6, 1e-6};
    for (int group = 0; group < 4; ++group)
      EXPECT_LE(std::sqrt(errors[group] / sizes[group]), tolerance[group]) << "rows of kind " << group;
  }
}

}  // namespace
}  // namespace tunica::coupling
