// Whole time steps of fluid-structure interaction: seconds, iterations, memory, and where the time goes.
//
//   benchmark_time_step pipe_fsi|tube_50k|tube_300k [steps] [linear tolerance] [neo_hooke|dfd] [ms]
//   mpirun -n 2 benchmark_time_step pipe_fsi 3 1e-6
//
// dfd: a wall with two families of dispersed fibres by the default rule. Compare walls in processes of their own: of
// two problems in one process the second one's linear solver runs a tenth faster at equal iterations.
//
// The tubes are generated; tube_300k takes a time step that is smaller by the ratio of the edge lengths, so that the
// Courant numbers agree. pipe_fsi is read where the data folder is present.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/interface.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/message.hpp"
#include "tunica/parallel/petsc.hpp"
#include "tunica/wall/parameters.hpp"

namespace {

using namespace tunica;

struct Setting {
  mesh::MeshData data;
  coupling::ProblemInput input;
  double dt = 1e-4;
};

mesh::MeshData read_pipe() {
  const std::filesystem::path folder = std::filesystem::path(TUNICA_SHARED_DATA) / "pipe_fsi";
  if (!std::filesystem::exists(folder))
    throw InputError(folder.string(), "the folder does not exist", "run this benchmark beside the shared data");
  const mesh_io::SimVascularOptions options{.metres_per_unit = 0.01};
  const mesh::LoadedMesh parts[2] = {
      mesh_io::read_simvascular(folder / "lumen", mesh::RegionKind::lumen, "lumen", options),
      mesh_io::read_simvascular(folder / "wall", mesh::RegionKind::wall, "wall", options)};
  const mesh::Interface pair{{"lumen_wall"}, {"wall_inner"}};
  return mesh::join(parts, std::span(&pair, 1), {}).data;
}

wall::LawParameters wall_law(const std::string& name) {
  if (name == "neo_hooke") {
    wall::NeoHookeParameters law;
    law.elastic.young_modulus = 1e6;
    law.elastic.poisson_ratio = 0.3;
    return law;
  }
  if (name != "dfd") throw InputError("benchmark_time_step", "'" + name + "' is not a wall", "neo_hooke or dfd");
  wall::DfdParameters law;
  law.elastic.young_modulus = 1e6;
  law.elastic.poisson_ratio = 0.3;
  for (const double angle : {0.6, -0.6}) {
    wall::dfd::Family family;
    family.energy = {60e3, 12.0};
    family.orientation = wall::dfd::Bivariate{2.5, 15.0, angle};
    law.families.push_back(family);
  }
  return law;
}

// Physics of the pipe_fsi case (docs/verification.md) on every mesh.
Setting make_setting(const std::string& name, bool root) {
  Setting s;
  mesh::TubeSizes tube{.radius = 0.01,
                       .length = 0.1,
                       .wall_thickness = 0.002,
                       .cells_around = 56,
                       .cells_radial = 7,
                       .cells_along = 60,
                       .cells_through_wall = 3};
  if (name == "tube_300k") {
    const double refine = 1.8;
    tube.cells_around = 104, tube.cells_radial = 13, tube.cells_along = 106, tube.cells_through_wall = 5;
    s.dt /= refine;
  } else if (name != "tube_50k" && name != "pipe_fsi") {
    throw InputError("benchmark_time_step", "'" + name + "' is not a benchmark", "pipe_fsi, tube_50k or tube_300k");
  }
  if (root) s.data = name == "pipe_fsi" ? read_pipe() : mesh::tube(tube);

  s.input.fluid = fluid::Parameters{.density = 1000, .viscosity = fluid::Newtonian{4e-3}};
  s.input.wall = wall::Parameters{};
  s.input.wall->density = 1000;
  s.input.wall->volumetric_energy = wall::VolumetricEnergy::miehe;
  s.input.wall->fibre_frame = wall::CylindricalFrame{};
  bc::Fixed sliding;
  sliding.directions = {false, false, true, false, false};
  s.input.boundary.fluid = s.input.fluid;
  s.input.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  s.input.boundary.conditions = {{"lumen_inlet", bc::Pressure{bc::WaveformInput{5e3}}},
                                 {"lumen_outlet", bc::Pressure{bc::WaveformInput{0.0}}},
                                 {"wall_inlet", sliding},
                                 {"wall_outlet", sliding},
                                 {"wall_outer", bc::Free{}}};
  s.input.newton.relative_tolerance = 1e-6;
  return s;
}

/// A problem and what its steps took.
struct Candidate {
  Candidate(std::string law, const distributed::DistributedMesh& mesh, coupling::ProblemInput input)
      : name(std::move(law)) {
    input.wall->material = wall_law(name);
    problem = std::make_unique<coupling::Problem>(mesh, input);
    state = problem->initial_state();
  }

  void advance(double dt, bool print) {
    const auto report = problem->advance(state, dt);
    if (!report.converged) throw SolverError("step " + std::to_string(state.step + 1) + ": " + report.failure);
    const auto& t = report.timings;
    newton += static_cast<int>(report.iterations.size()), linear += report.linear_iterations();
    sum.total += t.total, sum.assembly += t.assembly, sum.set_up += t.set_up, sum.linear += t.linear;
    sum.mesh += t.mesh;
    if (!print) return;
    std::printf("%-9s step %ld: %.2f s, Newton %zu, linear", name.c_str(), static_cast<long>(state.step), t.total,
                report.iterations.size());
    for (const auto& i : report.iterations) std::printf(" %d", i.linear_iterations);
    std::printf(", mesh");
    for (const auto& i : report.iterations) std::printf(" %d", i.mesh_iterations);
    std::printf("\n");
    std::fflush(stdout);
  }

  void summarise(int steps, double elements) const {
    std::printf(
        "%s: per step %.2f s; per tetrahedron and Newton iteration %.2f us; linear iterations per solve %.1f\n"
        "share: assembly %.0f %%, preconditioner set-up %.0f %%, linear solve %.0f %%, mesh motion %.0f %%\n",
        name.c_str(), sum.total / steps, 1e6 * sum.total / newton / elements, static_cast<double>(linear) / newton,
        100 * sum.assembly / sum.total, 100 * sum.set_up / sum.total, 100 * sum.linear / sum.total,
        100 * sum.mesh / sum.total);
  }

  std::string name;
  std::unique_ptr<coupling::Problem> problem;
  coupling::State state;
  int newton = 0, linear = 0;
  coupling::StepTimings sum;
};

void run(const std::string& name, int steps, double tolerance, const std::string& walls, double milliseconds) {
  const MPI_Comm comm = MPI_COMM_WORLD;
  const bool root = parallel::rank(comm) == 0;
  Setting s = parallel::agree(comm, [&] { return make_setting(name, root); });
  if (milliseconds > 0) s.dt = 1e-3 * milliseconds;
  s.input.linear.tolerance = s.input.linear.first_tolerance = tolerance;
  const auto mesh = distributed::distribute(s.data, comm);
  s.data = {};
  Candidate candidate(walls, mesh, s.input);
  if (root)
    std::printf("%s: %ld nodes, %ld tetrahedra, %d ranks, %s, dt %.3g s, linear tolerance %.0e\n", name.c_str(),
                static_cast<long>(mesh.global_nodes), static_cast<long>(mesh.global_elements), parallel::size(comm),
                assembly::name(assembly::choose_isa()), s.dt, tolerance);
  for (int k = 0; k < steps; ++k) candidate.advance(s.dt, root);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = parallel::global_sum(comm, 1024.0 * static_cast<double>(usage.ru_maxrss));
  if (!root) return;
  const auto elements = static_cast<double>(mesh.global_elements);
  candidate.summarise(steps, elements);
  std::printf("peak memory %.2f GB, %.2f kB per tetrahedron\n", 1e-9 * memory, 1e-3 * memory / elements);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    const parallel::Session session;
    try {
      if (argc < 2) throw InputError("benchmark_time_step", "no name given", "pipe_fsi, tube_50k or tube_300k");
      run(argv[1], argc > 2 ? std::atoi(argv[2]) : 3, argc > 3 ? std::atof(argv[3]) : 1e-6,
          argc > 4 ? argv[4] : "neo_hooke", argc > 5 ? std::atof(argv[5]) : 0.0);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      status = 1;
    }
  }
  MPI_Finalize();
  return status;
}
