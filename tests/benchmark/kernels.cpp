// Element loops, matrix-vector product and preconditioner on one core: microseconds per element, GB/s.
//
//   benchmark_kernels [--benchmark_filter=...]
//
// The mesh is a generated compliant tube of about 50 k nodes, ordered as in a run.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <vector>

#include "tunica/assembly/linear_solver.hpp"
#include "tunica/coupling/lumen_groups.hpp"
#include "tunica/coupling/wall_model.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/parallel/petsc.hpp"

namespace {

using namespace tunica;

struct Setting {
  assembly::Isa isa = assembly::choose_isa();
  distributed::DistributedMesh mesh;
  assembly::BlockPattern pattern;
  assembly::BlockMatrix matrix;
  std::vector<double> reference, position, velocity_pressure, acceleration, mesh_velocity, displacement, residual;
  coupling::LumenGroup lumen, lumen_beside_wall;
  coupling::WallModel wall_model;
  coupling::WallModel::Group wall, wall_split;

  static wall::Parameters wall_parameters() {
    wall::Parameters parameters;
    parameters.density = 1200;
    parameters.material = wall::NeoHookeParameters{{.shear_modulus = 1e5, .bulk_modulus = 1e7}};
    return parameters;
  }

  Setting()
      : mesh(distributed::distribute(mesh::tube({.radius = 0.01,
                                                 .length = 0.1,
                                                 .wall_thickness = 0.002,
                                                 .cells_around = 64,
                                                 .cells_radial = 8,
                                                 .cells_along = 64,
                                                 .cells_through_wall = 3}),
                                     MPI_COMM_WORLD)),
        pattern(assembly::make_pattern(mesh)),
        matrix(pattern),
        wall_model(mesh, wall_parameters()) {
    const std::size_t n = 4 * static_cast<std::size_t>(mesh.nodes());
    for (auto* field : {&reference, &velocity_pressure, &acceleration, &mesh_velocity, &displacement, &residual})
      field->assign(n, 0.0);
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      for (int c = 0; c < 3; ++c) {
        const std::size_t k = 4 * static_cast<std::size_t>(i) + c;
        reference[k] = mesh.points[i][c];
        velocity_pressure[k] = 0.1 + mesh.points[i][c];
        displacement[k] = 1e-3 * mesh.points[i][(c + 1) % 3];
      }
    position = reference;
    const int w = static_cast<int>(isa);
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
      if (mesh.regions[r].kind == mesh::RegionKind::lumen)
        for (auto& group : coupling::lumen_groups(mesh, mesh.regions[r], beside_interface(), pattern, w))
          (group.moves.empty() ? lumen : lumen_beside_wall) = std::move(group);
      else
        for (auto& group : wall_model.groups(mesh, r, pattern, w))
          (group.batches.split ? wall_split : wall) = std::move(group);
    }
  }

  std::vector<char> beside_interface() const {
    std::vector<char> follows(static_cast<std::size_t>(mesh.nodes()), 0);
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      if (mesh.host[i] != i) follows[static_cast<std::size_t>(mesh.host[i])] = 1;
    return follows;
  }
  coupling::FieldsView fields() const {
    return {reference.data(),    position.data(),      velocity_pressure.data(),
            acceleration.data(), mesh_velocity.data(), displacement.data()};
  }
  void run_fluid(const coupling::LumenGroup& group, bool tangent) {
    const fluid::Parameters parameters{.density = 1060, .viscosity = fluid::Newtonian{4e-3}};
    coupling::element_loops(isa).fluid(group.view(), fields(), parameters, {1e-4, 1e4, 0.67}, {1e-4, 0.67},
                                       {residual.data(), tangent ? matrix.blocks.data()->a : nullptr});
  }
  void run_wall(const coupling::WallModel::Group& group, bool tangent, bool mixed) {
    auto settings = wall_model.element_settings();
    settings.mixed = mixed;
    coupling::element_loops(isa).wall.assemble(group.view(), fields(), settings, {1e4, 1e-4, 1e4},
                                               {residual.data(), tangent ? matrix.blocks.data()->a : nullptr});
  }
  void assemble() {
    matrix.set_zero();
    run_fluid(lumen, true);
    run_fluid(lumen_beside_wall, true);
    run_wall(wall, true, true);
    run_wall(wall_split, true, true);
    // Twin nodes have no motion of their own.
    std::vector<assembly::NodeConstraint> twins;
    for (std::int32_t i = 0; i < mesh.nodes(); ++i)
      if (mesh.host[i] != i) twins.push_back({i, Mat3<double>{}, false});
    assembly::Constraints(pattern, twins).apply(matrix);
  }
};

Setting& setting() {
  static Setting s;
  return s;
}

void per_element(benchmark::State& state, std::int32_t elements) {
  state.counters["us_per_element"] =
      benchmark::Counter(static_cast<double>(elements) * 1e-6 * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
void bytes(benchmark::State& state, double bytes_per_iteration) {
  state.counters["GB/s"] = benchmark::Counter(bytes_per_iteration * 1e-9 * static_cast<double>(state.iterations()),
                                              benchmark::Counter::kIsRate);
}

void fluid_tangent(benchmark::State& state) {
  for (auto _ : state) setting().run_fluid(setting().lumen, true);
  per_element(state, setting().lumen.batches.elements);
}
void fluid_tangent_beside_wall(benchmark::State& state) {
  for (auto _ : state) setting().run_fluid(setting().lumen_beside_wall, true);
  per_element(state, setting().lumen_beside_wall.batches.elements);
}
void fluid_residual(benchmark::State& state) {
  for (auto _ : state) setting().run_fluid(setting().lumen, false);
  per_element(state, setting().lumen.batches.elements);
}
void wall_mixed_tangent(benchmark::State& state) {
  for (auto _ : state) setting().run_wall(setting().wall, true, true);
  per_element(state, setting().wall.batches.elements);
}
void wall_mixed_tangent_at_interface(benchmark::State& state) {
  for (auto _ : state) setting().run_wall(setting().wall_split, true, true);
  per_element(state, setting().wall_split.batches.elements);
}
void wall_displacement_tangent(benchmark::State& state) {
  for (auto _ : state) setting().run_wall(setting().wall, true, false);
  per_element(state, setting().wall.batches.elements);
}
void wall_mixed_residual(benchmark::State& state) {
  for (auto _ : state) setting().run_wall(setting().wall, false, true);
  per_element(state, setting().wall.batches.elements);
}

// STREAM triad on arrays far larger than the caches (McCalpin 1995).
void stream_triad(benchmark::State& state) {
  const std::size_t n = std::size_t{1} << 25;
  static std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  for (auto _ : state) {
    double* x = a.data();
    const double *y = b.data(), *z = c.data();
    for (std::size_t i = 0; i < n; ++i) x[i] = y[i] + 3.0 * z[i];
    benchmark::DoNotOptimize(x);
    benchmark::ClobberMemory();
  }
  bytes(state, 24.0 * static_cast<double>(n));
}
void matrix_vector_product(benchmark::State& state) {
  Setting& s = setting();
  s.assemble();
  std::vector<double> y(4 * static_cast<std::size_t>(s.pattern.rows));
  for (auto _ : state) s.matrix.multiply(s.isa, s.velocity_pressure, y);
  bytes(state, 68.0 * s.pattern.blocks() + 68.0 * s.pattern.rows);
  state.counters["ns_per_block"] =
      benchmark::Counter(1e-9 * s.pattern.blocks() * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
void preconditioner_set_up(benchmark::State& state) {
  Setting& s = setting();
  s.assemble();
  assembly::SchurPreconditioner preconditioner(s.mesh, s.pattern, s.isa);
  for (auto _ : state) preconditioner.update(s.matrix, {});
}
void preconditioner_apply(benchmark::State& state) {
  Setting& s = setting();
  s.assemble();
  assembly::SchurPreconditioner preconditioner(s.mesh, s.pattern, s.isa);
  preconditioner.update(s.matrix, {});
  std::vector<double> z(4 * static_cast<std::size_t>(s.pattern.rows));
  for (auto _ : state) preconditioner.apply(std::span(s.velocity_pressure).first(z.size()), z);
}

BENCHMARK(stream_triad)->Unit(benchmark::kMillisecond);
BENCHMARK(fluid_residual)->Unit(benchmark::kMillisecond);
BENCHMARK(fluid_tangent_beside_wall)->Unit(benchmark::kMillisecond);
BENCHMARK(fluid_tangent)->Unit(benchmark::kMillisecond);
BENCHMARK(wall_mixed_residual)->Unit(benchmark::kMillisecond);
BENCHMARK(wall_mixed_tangent)->Unit(benchmark::kMillisecond);
BENCHMARK(wall_mixed_tangent_at_interface)->Unit(benchmark::kMillisecond);
BENCHMARK(wall_displacement_tangent)->Unit(benchmark::kMillisecond);
BENCHMARK(matrix_vector_product)->Unit(benchmark::kMillisecond);
BENCHMARK(preconditioner_set_up)->Unit(benchmark::kMillisecond);
BENCHMARK(preconditioner_apply)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    const tunica::parallel::Session session;
    benchmark::Initialize(&argc, argv);
    std::printf("instruction set %s, %d nodes, %d lumen and %d wall elements (%d of them along the interface)\n",
                tunica::assembly::name(setting().isa), setting().mesh.nodes(),
                setting().lumen.batches.elements + setting().lumen_beside_wall.batches.elements,
                setting().wall.batches.elements + setting().wall_split.batches.elements,
                setting().wall_split.batches.elements);
    benchmark::RunSpecifiedBenchmarks();
  }
  MPI_Finalize();
}
