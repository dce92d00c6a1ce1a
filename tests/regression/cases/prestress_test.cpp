// `tunica prestress` on a small tube, and the runs that start from what it finds.
#include "tunica/stages/prestress/prestress.hpp"

#include <algorithm>
#include <cstdio>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"
#include "tunica/mesh_io/simvascular.hpp"

namespace tunica::test {
namespace {

/// Steady flow at 80 mmHg through a compliant tube; `wall` and `section` go into the sections wall and prestress.
std::string steady_case(const std::string& wall, const std::string& section = "",
                        const std::string& elements = "linear") {
  return "analysis: fsi\nelements: " + elements +
         "\n"
         "meshes:\n  tube: {" +
         coarse_tube +
         ", wall_thickness: 1 mm}\n"
         "  interface: {lumen: lumen_wall, wall: wall_inner}\n"
         "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
         "wall:\n  density: 1.12 g/cm^3\n  prestress: prestress/wall.vtu\n" +
         wall +
         "boundary:\n"
         "  lumen_inlet: {flow: 20 ml/s}\n"
         "  lumen_outlet: {resistance: {resistance: 5.332895e8 Pa s/m^3}}\n"
         "  wall_inlet: fixed\n  wall_outlet: fixed\n  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n" +
         "start: prestress/start.checkpoint\nprestress: {flow: {pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: "
         "400, tolerance: 1e-6}, tolerance: "
         "1e-4 mm" +
         section +
         "}\n"
         "newton: {relative_tolerance: 1e-6, reference_fraction: 1e-4}\n"
         "linear: {tolerance: 1e-5}\n"
         "time: {step: 1 ms, steps: 10}\noutput: {every: 10, checkpoint_every: 5}\n";
}

const std::string neo_hooke = "  material: {neo_hooke: {young_modulus: 400 kPa, poisson_ratio: 0.49}}\n";
const std::string dfd =
    "  fibre_frame: {cylindrical: {origin: [0 mm, 0 mm, 0 mm], axis: [0, 0, 1]}}\n"
    "  material:\n    dfd:\n      shear_modulus: 40 kPa\n      poisson_ratio: 0.49\n      families:\n"
    "        - {k1: 60 kPa, k2: 5, bivariate_von_mises: {a: 2.5, b: 15, mean_angle: 35 deg}}\n"
    "        - {k1: 60 kPa, k2: 5, bivariate_von_mises: {a: 2.5, b: 15, mean_angle: -35 deg}}\n";

void find(const fs::path& case_file, const fs::path& directory, MPI_Comm comm = MPI_COMM_WORLD) {
  stages::PrestressRequest request;
  request.case_file = case_file;
  request.directory = directory;
  request.program = {"test", "none"};
  stages::prestress(comm, request, nullptr);
  MPI_Barrier(comm);
}

double largest_displacement(const fs::path& results) {
  const Table balance(results / "balance.csv");
  const auto& u = balance["max displacement [mm]"];
  return *std::max_element(u.begin(), u.end());
}

struct Variant {
  const char* name;
  std::string wall, section, elements = "linear";
};

class PrestressedTube : public testing::TestWithParam<Variant> {};

// The asked 1e-4 of the radius are 0.5 um; without prestress the wall moves by a quarter of a millimetre.
TEST_P(PrestressedTube, StaysWhereItIs) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", steady_case(GetParam().wall, GetParam().section, GetParam().elements));
  find(file, folder.path() / "prestress");
  run(file);
  const double moved = largest_displacement(folder.path() / "results");
  if (parallel::rank(MPI_COMM_WORLD) == 0) std::printf("%s: moves by %.2e mm\n", GetParam().name, moved);
  EXPECT_LT(moved, 5e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Walls, PrestressedTube,
    testing::Values(Variant{"neo_hooke", neo_hooke, ""}, Variant{"second_piola", neo_hooke, ", update: second_piola"},
                    Variant{"inverse", neo_hooke, ", method: inverse"},
                    Variant{"quadratic_dfd_inverse", dfd, ", method: inverse", "quadratic"},
                    Variant{"stretch", neo_hooke, ", method: stretch"}, Variant{"dfd", dfd, ""},
                    Variant{"dfd_stretch", dfd, ", method: stretch"},
                    Variant{"displacement",
                            "  element: displacement\n  material: {neo_hooke: {young_modulus: 400 kPa, "
                            "poisson_ratio: 0.3}}\n",
                            ""},
                    Variant{"quadratic", neo_hooke, "", "quadratic"},
                    Variant{"quadratic_dfd_stretch", dfd, ", method: stretch", "quadratic"},
                    Variant{"quadratic_displacement",
                            "  element: displacement\n  material: {neo_hooke: {young_modulus: 400 kPa, "
                            "poisson_ratio: 0.3}}\n",
                            "", "quadratic"}),
    [](const auto& variant) { return variant.param.name; });

TEST(Prestress, WithoutItTheTubeIsBlownUpOnceMore) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", steady_case(neo_hooke));
  find(file, folder.path() / "prestress");
  std::string text = slurp(file);
  text.erase(text.find("  prestress: prestress/wall.vtu\n"), 32);
  const auto bare = folder.write("bare.yaml", text);
  run(bare);
  EXPECT_GT(largest_displacement(folder.path() / "results"), 0.05);
}

class PrestressOf : public testing::TestWithParam<const char*> {
 protected:
  std::string with_elements() const { return steady_case(neo_hooke, "", GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Elements, PrestressOf, testing::Values("linear", "quadratic"),
                         [](const auto& elements) { return std::string(elements.param); });

TEST_P(PrestressOf, IsTheSameOnAnyNumberOfRanks) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", with_elements());
  find(file, folder.path() / "prestress");
  if (parallel::rank(MPI_COMM_WORLD) == 0) find(file, folder.path() / "alone", MPI_COMM_SELF);
  MPI_Barrier(MPI_COMM_WORLD);
  stages::RunRequest request;
  request.until = 2;
  run(file, request);
  std::string text = slurp(file);
  text.replace(text.find("prestress/wall.vtu"), 18, "alone/wall.vtu");
  text.replace(text.find("prestress/start"), 15, "alone/start");
  request.directory = folder.path() / "other";
  run(folder.write("alone.yaml", text), request);
  const Table a(folder.path() / "results/balance.csv"), b(folder.path() / "other/balance.csv");
  EXPECT_NEAR(a.last("lumen volume [mm^3]"), b.last("lumen volume [mm^3]"), 1e-6 * a.last("lumen volume [mm^3]"));
  EXPECT_NEAR(a.last("max displacement [mm]"), b.last("max displacement [mm]"), 2e-4);
}

TEST_P(PrestressOf, RunGoesOnBitForBit) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", with_elements());
  find(file, folder.path() / "prestress");
  stages::RunRequest request;
  request.directory = folder.path() / "whole";
  run(file, request);
  request.directory = folder.path() / "parts";
  request.until = 5;
  run(file, request);
  request.until.reset();
  request.restart = true;
  run(file, request);
  const auto checkpoint = [&](const char* results) {
    return slurp(folder.path() / results / "checkpoints/step_00000010.checkpoint");
  };
  EXPECT_FALSE(checkpoint("whole").empty());
  EXPECT_TRUE(checkpoint("whole") == checkpoint("parts")) << "the states differ";
}

TEST(Prestress, KeepsTheFlowWhenTheFixedPointFails) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", steady_case(neo_hooke, ", max_iterations: 1"));
  const auto found = folder.path() / "prestress";
  EXPECT_NE(message_of<SolverError>([&] { find(file, found); }).find("did not converge"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  for (const char* kept : {"flow.checkpoint", "flow/lumen.hdf.series", "traction/wall.hdf.series", "boundary.yaml",
                           "fixed_point.csv", "fixed_point.svg", "prestress.json"})
    EXPECT_TRUE(fs::exists(found / kept)) << kept;
  EXPECT_FALSE(fs::exists(found / "wall.vtu"));
  EXPECT_FALSE(fs::exists(found / "start.checkpoint"));
  EXPECT_NE(message_of<InputError>([&] { run(file); }).find("wall.vtu"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { find(file, found); }).find("holds a prestress already"), std::string::npos);
  stages::PrestressRequest again;
  again.case_file = folder.write("case.yaml", steady_case(neo_hooke));
  again.directory = found;
  again.keep_flow = true;
  stages::prestress(MPI_COMM_WORLD, again, nullptr);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(found / "wall.vtu"));
}

// Meshes of other programs hold coordinates in single precision: the nodes of the interface, which take the place of
// the lumen's, are not quite those of the wall alone.
TEST(Prestress, OfAWallAloneIsTakenBesideItsBlood) {
  const SharedFolder folder;
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    auto tube = mesh::tube({.radius = 0.005,
                            .length = 0.01,
                            .wall_thickness = 0.001,
                            .cells_around = 8,
                            .cells_radial = 1,
                            .cells_along = 3,
                            .cells_through_wall = 1});
    mesh_io::write_simvascular(folder.path() / "wall", tube, mesh::RegionKind::wall, 0.01);
    for (auto& x : tube.points)
      for (int i = 0; i < 3; ++i) x[i] = static_cast<float>(x[i]);
    mesh_io::write_simvascular(folder.path() / "lumen", tube, mesh::RegionKind::lumen, 0.01);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string wall = "wall:\n  density: 1.12 g/cm^3\n  prestress: prestress/wall.vtu\n" + neo_hooke;
  const std::string held =
      "  wall_inlet: fixed\n  wall_outlet: fixed\n  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n";
  const auto alone = folder.write(
      "alone.yaml",
      "analysis: {static_wall: {load_steps: 1}}\nelements: linear\nmeshes: {length_unit: cm, wall: {simvascular: "
      "wall}}\n" +
          wall + "boundary:\n  wall_inner: {pressure: 80 mmHg}\n" + held + "prestress: {}\n");
  find(alone, folder.path() / "prestress");
  const auto coupled =
      folder.write("coupled.yaml",
                   "analysis: fsi\nelements: linear\nmeshes:\n  length_unit: cm\n  lumen: {simvascular: lumen}\n  "
                   "wall: {simvascular: "
                   "wall}\n  interface: {lumen: lumen_wall, wall: wall_inner}\n"
                   "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n" +
                       wall + "boundary:\n  lumen_inlet: {pressure: 80 mmHg}\n  lumen_outlet: {pressure: 80 mmHg}\n" +
                       held + "time: {step: 1 ms, steps: 5}\nnewton: {relative_tolerance: 1e-6}\n");
  run(coupled);
  // Without prestress the wall moves by a quarter of a millimetre.
  EXPECT_LT(largest_displacement(folder.path() / "results"), 0.005);
}

TEST(Prestress, OfAWallAloneTakesItsOwnLoads) {
  const SharedFolder folder;
  if (parallel::rank(MPI_COMM_WORLD) == 0)
    mesh_io::write_simvascular(
        folder.path() / "mesh",
        mesh::thick_cylinder(
            {.inner = 0.01, .outer = 0.012, .length = 0.002, .cells_radial = 2, .cells_around = 32, .cells_along = 1},
            mesh::Sector::quarter),
        mesh::RegionKind::wall, 0.01);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto file = folder.write(
      "case.yaml",
      "analysis: {static_wall: {load_steps: 1}}\nelements: linear\nmeshes: {length_unit: cm, wall: {simvascular: "
      "mesh}}\n"
      "wall:\n  density: 1.12 g/cm^3\n  prestress: prestress/wall.vtu\n" +
          neo_hooke +
          "boundary:\n  wall_inner: {pressure: 80 mmHg}\n  wall_outer: free\n"
          "  wall_inlet: {fixed: {directions: [z]}}\n  wall_outlet: {fixed: {directions: [z]}}\n"
          "  symmetry_x: {fixed: {directions: [x]}}\n  symmetry_y: {fixed: {directions: [y]}}\nprestress: {}\n");
  find(file, folder.path() / "prestress");
  run(file);
  EXPECT_LT(largest_displacement(folder.path() / "results"), 1e-3);
}

}  // namespace
}  // namespace tunica::test
