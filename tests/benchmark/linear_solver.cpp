// The linear solver on systems that are hard for it: iterations and seconds of each step.
//
//   benchmark_linear_solver CASE [key=value ...]
//     tube       flow in a compliant tube with an open outer surface, driven by pressure
//     wall       a tube of HGO fibres under pressure, alone; steps=0: statics
//     strip      a soft strip with a cap of 1e9 Pa at its end, held at the other one, under pressure; statics
//     FOLDER     with `lumen` and `wall` as `tunica mesh` writes them (in mm), steady inflow, resistances
//   dt=5 [ms] steps=3 quadratic=1 around=24 young=4e5 [Pa] nu=0.49 mixed=1 tolerance=1e-4 rigid=0
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "tunica/base/error.hpp"
#include "tunica/coupling/problem.hpp"
#include "tunica/mesh/edge_nodes.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh/interface.hpp"
#include "tunica/mesh_io/simvascular.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/message.hpp"
#include "tunica/parallel/petsc.hpp"
#include "tunica/wall/parameters.hpp"

namespace {

using namespace tunica;

struct Options {
  std::map<std::string, double> values{{"dt", 5},    {"steps", 3}, {"quadratic", 1},    {"around", 24}, {"young", 4e5},
                                       {"nu", 0.49}, {"mixed", 1}, {"tolerance", 1e-4}, {"rigid", 0}};

  double operator[](const std::string& key) const { return values.at(key); }
  void read(const std::string& text) {
    const auto equals = text.find('=');
    const auto found = values.find(text.substr(0, equals));
    if (equals == std::string::npos || found == values.end())
      throw InputError("benchmark_linear_solver", "'" + text + "' is no setting", "see the head of its source");
    found->second = std::atof(text.c_str() + equals + 1);
  }
};

struct Setting {
  mesh::MeshData data;
  coupling::ProblemInput input;
};

bc::Fixed held(bool x, bool y, bool z) {
  bc::Fixed fixed;
  fixed.directions = {x, y, z, false, false};
  return fixed;
}

void add_wall(const Options& options, wall::LawParameters law, Setting& s) {
  s.input.wall = wall::Parameters{};
  s.input.wall->density = 1100;
  s.input.wall->element = options["mixed"] > 0 ? wall::Element::mixed : wall::Element::displacement;
  s.input.wall->material = std::move(law);
  s.input.wall->fibre_frame = wall::CylindricalFrame{};
  s.input.boundary.wall_has_pressure = options["mixed"] > 0;
}

wall::NeoHookeParameters neo_hooke(double young, double nu) {
  wall::NeoHookeParameters law;
  law.elastic.young_modulus = young;
  law.elastic.poisson_ratio = nu;
  return law;
}

void add_fluid(Setting& s) {
  s.input.fluid = fluid::Parameters{.density = 1060, .viscosity = fluid::Newtonian{4e-3}};
  s.input.boundary.fluid = s.input.fluid;
}

Setting tube(const Options& options) {
  Setting s;
  const int around = static_cast<int>(options["around"]);
  const bool rigid = options["rigid"] > 0;
  s.data = mesh::tube({.radius = 0.01,
                       .length = 0.1,
                       .wall_thickness = rigid ? 0.0 : 0.002,
                       .cells_around = around,
                       .cells_radial = around / 8,
                       .cells_along = around,
                       .cells_through_wall = 1});
  add_fluid(s);
  bc::WaveformInput push{1e3};
  push.ramp_time = 0.02;
  s.input.boundary.conditions = {{"lumen_inlet", bc::Pressure{push}}, {"lumen_outlet", bc::Resistance{1e7}}};
  if (rigid) {
    s.input.boundary.conditions.emplace_back("lumen_wall", bc::NoSlip{});
    return s;
  }
  add_wall(options, neo_hooke(options["young"], options["nu"]), s);
  s.input.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  s.input.boundary.conditions.insert(s.input.boundary.conditions.end(), {{"wall_inlet", held(false, false, true)},
                                                                         {"wall_outlet", held(false, false, true)},
                                                                         {"wall_outer", bc::Support{1e6}}});
  return s;
}

Setting wall_alone(const Options& options) {
  Setting s;
  const int around = static_cast<int>(options["around"]);
  s.data = mesh::thick_cylinder({.inner = 0.01,
                                 .outer = 0.012,
                                 .length = 0.06,
                                 .cells_radial = std::max(1, around / 16),
                                 .cells_around = around,
                                 .cells_along = around},
                                mesh::Sector::full);
  wall::HgoParameters law;
  law.elastic.shear_modulus = 40e3;
  law.elastic.poisson_ratio = options["nu"];
  for (const double angle : {0.6, -0.6}) law.families.push_back({{60e3, 12.0}, angle});
  add_wall(options, std::move(law), s);
  bc::WaveformInput push{2e3};
  if (options["steps"] > 0) push.ramp_time = 0.02;
  s.input.boundary.conditions = {{"wall_inner", bc::Pressure{push}},
                                 {"wall_outer", bc::Free{}},
                                 {"wall_inlet", held(true, true, true)},
                                 {"wall_outlet", held(true, true, true)}};
  return s;
}

Setting strip(const Options& options) {
  Setting s;
  s.data = mesh::box(14, 5, 1, {{0.025, 0.01, 0.002}}, mesh::RegionKind::wall);
  // The last cells are the cap.
  const std::size_t count = s.data.tetrahedra.size();
  std::vector<std::array<std::int64_t, 4>> soft, cap;
  for (std::size_t e = 0; e < count; ++e) {
    double x = 0;
    for (const auto node : s.data.tetrahedra[e]) x += 0.25 * s.data.points[node][0];
    (x > 0.0215 ? cap : soft)
        .push_back(
            {s.data.tetrahedra[e][0], s.data.tetrahedra[e][1], s.data.tetrahedra[e][2], s.data.tetrahedra[e][3]});
  }
  std::size_t to = 0;
  for (const auto* part : {&soft, &cap})
    for (const auto& e : *part) std::copy(e.begin(), e.end(), s.data.tetrahedra[to++].begin());
  auto region = s.data.regions[0];
  s.data.regions[0].end_element = static_cast<std::int64_t>(soft.size());
  region.name = "cap";
  region.first_element = static_cast<std::int64_t>(soft.size());
  s.data.regions.push_back(region);
  add_wall(options, neo_hooke(options["young"], options["nu"]), s);
  s.input.wall->regions["cap"].material = neo_hooke(1e9, 0.3);
  s.input.boundary.conditions = {{"z_max", bc::Pressure{bc::WaveformInput{10.0}}}, {"x_min", held(true, true, true)}};
  for (const char* face : {"x_max", "y_min", "y_max", "z_min"})
    s.input.boundary.conditions.emplace_back(face, bc::Free{});
  return s;
}

Setting from_folder(const std::filesystem::path& folder, const Options& options) {
  Setting s;
  const bool rigid = options["rigid"] > 0;
  const mesh_io::SimVascularOptions millimetres{.metres_per_unit = 0.001};
  std::vector<mesh::LoadedMesh> parts{
      mesh_io::read_simvascular(folder / "lumen", mesh::RegionKind::lumen, "lumen", millimetres)};
  if (!rigid) parts.push_back(mesh_io::read_simvascular(folder / "wall", mesh::RegionKind::wall, "wall", millimetres));
  const mesh::Interface pair{{"lumen_wall"}, {"wall_inner"}};
  s.data = rigid ? std::move(parts[0].data) : mesh::join(parts, std::span(&pair, 1), {}).data;
  add_fluid(s);
  if (!rigid) add_wall(options, neo_hooke(options["young"], options["nu"]), s);
  if (!rigid) s.input.boundary.interfaces = {{"lumen_wall", "wall_inner"}};
  bc::WaveformInput inflow{2e-4};
  inflow.ramp_time = 0.06;
  bc::Fixed normal;
  normal.directions = {false, false, false, true, false};
  for (const auto& face : s.data.faces) {
    const bool of_wall = s.data.regions[face.region].kind == mesh::RegionKind::wall;
    bc::Condition condition = of_wall ? bc::Condition{held(true, true, true)} : bc::Condition{bc::Resistance{4e8}};
    if (face.name == "lumen_inlet") condition = bc::Flow{.course = inflow};
    if (face.name == "wall_inlet") condition = normal;
    if (face.name == "wall_outer") condition = bc::Support{1e7};
    if (face.name == "lumen_wall" && rigid) condition = bc::NoSlip{};
    if (rigid || (face.name != "lumen_wall" && face.name != "wall_inner"))
      s.input.boundary.conditions.emplace_back(face.name, condition);
  }
  return s;
}

Setting make_setting(const std::string& name, const Options& options) {
  Setting s = name == "tube"    ? tube(options)
              : name == "wall"  ? wall_alone(options)
              : name == "strip" ? strip(options)
                                : from_folder(name, options);
  if (options["quadratic"] > 0) mesh::add_edge_nodes(s.data);
  return s;
}

void run(const std::string& name, const Options& options) {
  const MPI_Comm comm = MPI_COMM_WORLD;
  const bool root = parallel::rank(comm) == 0;
  Setting s = parallel::agree(comm, [&] { return make_setting(name, options); });
  s.input.rho_infinity = 0.2;
  s.input.linear.tolerance = options["tolerance"];
  const auto mesh = distributed::distribute(s.data, comm);
  s.data = {};
  coupling::Problem problem(mesh, s.input);
  auto state = problem.initial_state();
  const bool statics = options["steps"] == 0 || name == "strip";
  if (root)
    std::printf("%s: %ld nodes, %ld tetrahedra, %d ranks\n", name.c_str(), static_cast<long>(mesh.global_nodes),
                static_cast<long>(mesh.global_elements), parallel::size(comm));
  for (int k = 0; k < (statics ? 1 : static_cast<int>(options["steps"])); ++k) {
    const auto report = statics ? problem.solve_static(state, 1.0) : problem.advance(state, 1e-3 * options["dt"]);
    if (!root) continue;
    const auto& t = report.timings;
    std::printf("step %d: %.2f s (assembly %.2f, set-up %.2f, linear %.2f), linear %d =", k + 1, t.total, t.assembly,
                t.set_up, t.linear, report.linear_iterations());
    for (const auto& i : report.iterations) std::printf(" %d", i.linear_iterations);
    std::printf(" %s\n", report.failure.c_str());
    std::fflush(stdout);
  }
  double norm = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    for (int c = 0; c < 3; ++c) norm += std::pow(state.displacement[4 * i + c] + state.velocity_pressure[4 * i + c], 2);
  norm = std::sqrt(parallel::global_sum(comm, norm));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = parallel::global_sum(comm, 1024.0 * static_cast<double>(usage.ru_maxrss));
  if (root) std::printf("solution %.8e, peak memory %.0f MB\n", norm, 1e-6 * memory);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  {
    const parallel::Session session;
    try {
      if (argc < 2) throw InputError("benchmark_linear_solver", "no case given", "see the head of its source");
      Options options;
      for (int i = 2; i < argc; ++i) options.read(argv[i]);
      run(argv[1], options);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      status = 1;
    }
  }
  MPI_Finalize();
  return status;
}
