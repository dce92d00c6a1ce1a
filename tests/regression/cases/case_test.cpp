// Whole cases with integral quantities that must not change unnoticed, the same on any number of ranks. The expected
// numbers come from this program; verification against solutions from elsewhere has its own tests.
#include <algorithm>
#include <cmath>

#include "small_cases.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::test {
namespace {

/// Relative tolerance: differences between instruction sets and numbers of ranks stay below it by orders of magnitude.
constexpr double tolerance = 1e-5;

#define EXPECT_RELATIVE(value, expected) EXPECT_NEAR(value, expected, tolerance* std::abs(expected))

TEST(Case, PulseInACompliantTube) {
  const SharedFolder folder;
  const std::string printed = run(folder.write("case.yaml", coupled_case(10)));
  const fs::path results = folder.path() / "results";
  const Table faces(results / "faces.csv"), balance(results / "balance.csv"), steps(results / "steps.csv"),
      outlets(results / "outlets.csv");
  ASSERT_EQ(steps["step"].size(), 10u);
  EXPECT_NEAR(steps.last("time [ms]"), 1.0, 1e-12);
  for (const double r : balance["relative mass residual"]) EXPECT_LT(r, 1e-7);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_LT(std::abs(balance["interface power residual [W]"][k]),
              1e-6 * std::abs(balance["interface power wall [W]"][k]));
  EXPECT_RELATIVE(faces.last("lumen_inlet flow [ml/s]"), -1.898965462);
  EXPECT_RELATIVE(faces.last("lumen_outlet flow [ml/s]"), 0.1196328763);
  EXPECT_RELATIVE(outlets.last("lumen_outlet pressure [mmHg]"), 0.09463922659);
  EXPECT_RELATIVE(balance.last("lumen volume [mm^3]"), 1574.356595);
  EXPECT_RELATIVE(balance.last("wall strain energy [J]"), 5.042857037e-07);
  EXPECT_RELATIVE(balance.last("max displacement [mm]"), 0.01643238956);
  // P = R Q at the end of the step.
  EXPECT_NEAR(outlets.last("lumen_outlet pressure [mmHg]") * 133.322387415,
              1e8 * outlets.last("lumen_outlet flow [ml/s]") * 1e-6, 1e-4);

  for (const char* file : {"lumen.hdf.series", "wall.hdf.series", "results.xdmf", "lumen_mesh.hdf", "manifest.json",
                           "run.log", "lumen_000005.hdf", "wall_000010.hdf", "checkpoints/step_00000005.checkpoint",
                           "checkpoints/step_00000010.checkpoint"})
    EXPECT_TRUE(fs::exists(results / file)) << file;
  EXPECT_FALSE(fs::exists(results / "lumen_000003.hdf"));
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(printed.find("step 10/10  t 1 ms  newton"), std::string::npos) << printed;
    EXPECT_NE(printed.find("ETA 0:00, step 10/10  t 1 ms  "), std::string::npos) << printed;
    EXPECT_NE(printed.find("whole run: least, mean, largest"), std::string::npos) << printed;
    EXPECT_NE(slurp(results / "wall_000010.hdf").find("von Mises stress [kPa]"), std::string::npos);
    EXPECT_NE(slurp(results / "lumen_000010.hdf").find("wall shear stress [Pa]"), std::string::npos);
    EXPECT_NE(slurp(results / "manifest.json").find("\"status\": \"completed\""), std::string::npos);
  }
}

TEST(Case, RigidTubeWithWindkessel) {
  const SharedFolder folder;
  run(folder.write("case.yaml", windkessel_case(30)));
  const Table outlets(folder.path() / "results/outlets.csv"), balance(folder.path() / "results/balance.csv");
  for (const double r : balance["relative mass residual"]) EXPECT_LT(r, 1e-6);
  EXPECT_NEAR(outlets.last("lumen_outlet flow [ml/s]"), 20, 1e-5);
  // C dP_c/dt = Q - P_c / R_d by small steps, with the recorded flow.
  double stored = 0, flow = 0;
  for (const double next : outlets["lumen_outlet flow [ml/s]"]) {
    for (int k = 0; k < 1000; ++k) {
      const double q = (flow + (next - flow) * (k + 0.5) / 1000) * 1e-6;
      const double slope = (q - stored / 1e8) / 1e-9, middle = stored + 0.5 * 2e-6 * slope;
      stored += 2e-6 * (q - middle / 1e8) / 1e-9;
    }
    flow = next;
  }
  EXPECT_RELATIVE(outlets.last("lumen_outlet stored pressure [Pa]"), stored);
  EXPECT_NEAR(outlets.last("lumen_outlet pressure [Pa]"), stored + 1e7 * 20e-6, tolerance * stored);
  EXPECT_FALSE(fs::exists(folder.path() / "results/wall.hdf.series"));
}

TEST(Case, StaticWallUnderPressure) {
  const SharedFolder folder;
  const std::string text =
      "analysis: {static_wall: {load_steps: 4}}\nelements: linear\n"
      "meshes: {length_unit: m, wall: {simvascular: not_used}}\n"
      "wall: {density: 1.2 g/cm^3, material: {neo_hooke: {shear_modulus: 100 kPa, poisson_ratio: 0.45}}}\n"
      "newton: {relative_tolerance: 1e-8}\n"
      "boundary:\n"
      "  wall_inner: {pressure: 10 kPa}\n"
      "  wall_outer: free\n"
      "  wall_inlet: {fixed: {directions: [z]}}\n  wall_outlet: {fixed: {directions: [z]}}\n"
      "  symmetry_x: {fixed: {directions: [x]}}\n  symmetry_y: {fixed: {directions: [y]}}\n";
  stages::ReadCase c{case_file::parse_case(text, folder.path() / "case.yaml"), text, {}, {}, {}};
  c.mesh.data = mesh::thick_cylinder(
      {.inner = 0.01, .outer = 0.012, .length = 0.002, .cells_radial = 3, .cells_around = 32, .cells_along = 1},
      mesh::Sector::quarter);
  stages::run_case(c, {}, MPI_COMM_WORLD, nullptr);
  const Table balance(folder.path() / "results/balance.csv"), steps(folder.path() / "results/steps.csv");
  EXPECT_EQ(steps["load factor"], (std::vector{0.25, 0.5, 0.75, 1.0}));
  EXPECT_RELATIVE(balance.last("max displacement [mm]"), 2.912128807);
  EXPECT_RELATIVE(balance.last("wall strain energy [J]"), 0.0006361091372);
}

// Too few iterations for the jump of the load, enough for smaller steps.
TEST(Case, RejectedStepsAreHalvedAndTheGridIsReached) {
  const SharedFolder folder;
  const std::string more =
      "time: {step: 0.2 ms, steps: 6}\noutput: {every: 1, checkpoint_every: 5, units: {time: ms}}\n";
  std::string text = coupled_case(6, more + "newton: {relative_tolerance: 1e-8, max_iterations: 6}\n");
  const std::string pulse = "value: 1.3332 kPa, end: 0.3 ms";
  text.replace(text.find(pulse), pulse.size(), "value: 60 kPa, start: 0.45 ms, end: 0.75 ms");
  const std::string printed = run(folder.write("few.yaml", text));
  const Table steps(folder.path() / "results/steps.csv");
  const auto &time = steps["time [ms]"], &dt = steps["dt [ms]"];
  EXPECT_GT(time.size(), 6u);
  EXPECT_LT(*std::min_element(dt.begin(), dt.end()), 0.11);
  EXPECT_NEAR(time.back(), 1.2, 1e-12);
  for (std::size_t k = 0; k < time.size(); ++k) {
    EXPECT_NEAR(time[k] - (k > 0 ? time[k - 1] : 0.0), dt[k], 1e-9);
    EXPECT_LE(steps["newton iterations"][k], 6);
    EXPECT_EQ(steps["step"][k], static_cast<double>(k + 1));
  }
  for (int step = 1; step <= 6; ++step)
    EXPECT_TRUE(std::any_of(time.begin(), time.end(), [&](double t) { return std::abs(t - 0.2 * step) < 1e-9; }))
        << step;
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    EXPECT_NE(printed.find("rejected: Newton's method did not converge in 6 iterations"), std::string::npos) << printed;
  }
}

TEST(Case, AFailedRunKeepsWhatItHasAndSaysWhy) {
  const SharedFolder folder;
  const auto file = folder.write("case.yaml", coupled_case(10,
                                                           "time: {step: 0.1 ms, steps: 10, max_halvings: 2}\n"
                                                           "newton: {max_iterations: 1, relative_tolerance: 1e-9}\n"));
  const std::string message = message_of<SolverError>([&] { run(file); });
  for (const char* part :
       {"time step did not converge from t = 0 ms (after 0 steps), with steps down to 0.025 ms",
        "Newton's method did not converge", "residual norms", "largest unbalanced force", "step_00000000.checkpoint"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\nnot in\n" << message;
  EXPECT_NE(slurp(folder.path() / "results/manifest.json").find("\"status\": \"failed\""), std::string::npos);
  EXPECT_TRUE(fs::exists(folder.path() / "results/checkpoints/step_00000000.checkpoint"));
  EXPECT_TRUE(fs::exists(folder.path() / "results/lumen_000000.hdf"));
}

}  // namespace
}  // namespace tunica::test
