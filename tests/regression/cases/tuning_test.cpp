// `tunica tune` on small tubes, and the runs that take its outlets.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "small_cases.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"
#include "tunica/stages/prestress/prestress.hpp"
#include "tunica/stages/tuning/tune.hpp"

namespace tunica::test {
namespace {

constexpr double beat = 0.8, systole = 0.3, mean_flow = 20;  // s, s, ml/s

/// Half a sine wave and rest.
std::string inflow_table() {
  std::string text = "t,Q\n";
  for (int k = 0; k <= 80; ++k) {
    const double t = beat * k / 80, peak = mean_flow * beat * std::numbers::pi / (2 * systole);
    text += fmt::format("{:.6f},{:.6f}\n", t, t < systole ? peak * std::sin(std::numbers::pi * t / systole) : 0.0);
  }
  return text;
}

const std::string asked =
    "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: 8 ms}\n";
const std::string inlet = "  lumen_inlet: {flow: {table: {file: inflow.csv, time_unit: s, unit: ml/s}}}\n";

std::string rigid_case(const std::string& outlets = asked) {
  return "analysis: flow\nelements: linear\nmeshes: {tube: {" + coarse_tube +
         "}}\n"
         "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\nboundary:\n" +
         inlet + "  lumen_wall: no_slip\n" + outlets +
         "time: {step: 8 ms, steps: 200}\noutput: {every: 100, checkpoint_every: 100}\n";
}

std::string compliant_case() {
  return "analysis: fsi\nelements: linear\nmeshes:\n  tube: {" + coarse_tube +
         ", wall_thickness: 1 mm}\n  interface: {lumen: lumen_wall, wall: wall_inner}\n"
         "fluid: {density: 1.06 g/cm^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
         "wall:\n  density: 1.12 g/cm^3\n  prestress: prestress/wall.vtu\n"
         "  material: {neo_hooke: {young_modulus: 400 kPa, poisson_ratio: 0.49}}\nboundary:\n" +
         inlet +
         "  wall_inlet: fixed\n  wall_outlet: fixed\n  wall_outer: {support: {stiffness: 1e6 N/m^3}}\n"
         "start: prestress/start.checkpoint\n"
         "prestress: {flow: {pressure: 75 mmHg, inflow: 5 ml/s, step: 8 ms, steps: 400, tolerance: 1e-4}, tolerance: "
         "1e-3 mm}\n" +
         asked + "time: {step: 8 ms, steps: 200}\noutput: {every: 100, checkpoint_every: 100}\n";
}

void tune(const fs::path& file, bool overwrite = false) {
  stages::TuneRequest request;
  request.case_file = file;
  request.overwrite = overwrite;
  request.program = {"test", "none"};
  request.run_case = stages::run_case;
  EXPECT_EQ(stages::tune(MPI_COMM_WORLD, request, nullptr), 0);
  MPI_Barrier(MPI_COMM_WORLD);
}

/// Largest and smallest pressure at the inlet in the last period.
std::pair<double, double> last_pulse(const fs::path& results) {
  const Table faces(results / "faces.csv");
  const auto& t = faces["time [s]"];
  const auto& p = faces["lumen_inlet pressure [mmHg]"];
  double high = 0, low = 1e9;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] > t.back() - beat) high = std::max(high, p[k]), low = std::min(low, p[k]);
  return {high, low};
}

void expect_targets(const fs::path& results, const char* name) {
  const auto [high, low] = last_pulse(results);
  if (parallel::rank(MPI_COMM_WORLD) == 0)
    std::printf("%s: %.2f/%.2f mmHg in the last cycle of the run, asked 125/75\n", name, high, low);
  EXPECT_NEAR(high, 125, 0.02 * 125);
  EXPECT_NEAR(low, 75, 0.02 * 75);
}

TEST(Tuning, RigidTubeRunsAtItsTargets) {
  const SharedFolder folder;
  folder.write("inflow.csv", inflow_table());
  const auto file = folder.write("case.yaml", rigid_case());
  EXPECT_NE(message_of<InputError>([&] { run(file); }).find("tunica tune"), std::string::npos);
  tune(file);
  EXPECT_LE(Table(folder.path() / "outlets/tuning.csv")["cycle"].size(), 2u);
  run(file);
  expect_targets(folder.path() / "results", "rigid tube");
}

TEST(Tuning, CompliantTubeRunsAtItsTargets) {
  const SharedFolder folder;
  folder.write("inflow.csv", inflow_table());
  const auto file = folder.write("case.yaml", compliant_case());
  stages::PrestressRequest prestress;
  prestress.case_file = file;
  stages::prestress(MPI_COMM_WORLD, prestress, nullptr);
  tune(file);
  const Table cycles(folder.path() / "outlets/tuning.csv");
  EXPECT_LE(cycles["cycle"].size(), 2u);
  EXPECT_GT(cycles.last("vessel compliance [m^3/Pa]"), 0);
  EXPECT_LT(cycles.last("relative miss"), 0.02);
  run(file);
  expect_targets(folder.path() / "results", "compliant tube");
}

TEST(Tuning, IsNotComputedTwiceAndNoticesChanges) {
  const SharedFolder folder;
  folder.write("inflow.csv", inflow_table());
  const auto file = folder.write("case.yaml", rigid_case());
  tune(file);
  const auto manifest = folder.path() / "outlets/cycle_1/manifest.json";
  const std::string before = slurp(manifest), outlets = slurp(folder.path() / "outlets/outlets.yaml");
  MPI_Barrier(MPI_COMM_WORLD);
  // As after a kill within the first cycle.
  if (parallel::rank(MPI_COMM_WORLD) == 0) fs::remove(folder.path() / "outlets/outlets.yaml");
  MPI_Barrier(MPI_COMM_WORLD);
  tune(file);
  EXPECT_EQ(slurp(manifest), before);
  EXPECT_EQ(slurp(folder.path() / "outlets/outlets.yaml"), outlets);

  const std::string other =
      "outlets: {systolic: 120 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: 8 ms}\n";
  folder.write("case.yaml", rigid_case(other));
  EXPECT_NE(message_of<InputError>([&] { run(file); }).find("was tuned for a systolic pressure of 125 mmHg"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { tune(file); }).find("--overwrite"), std::string::npos);
  tune(file, true);
}

TEST(Tuning, RunsTheElementsOfTheCase) {
  const SharedFolder folder;
  folder.write("inflow.csv", inflow_table());
  std::string text = rigid_case(
      "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: 40 ms, tolerance: 0.1}\n");
  text.replace(text.find("linear"), 6, "quadratic");
  text.replace(text.find("steps: 200"), 10, "steps: 1");
  const auto file = folder.write("case.yaml", text);
  tune(file);
  run(file);
  const auto mesh_of = [&](const char* results) {
    return nlohmann::json::parse(slurp(folder.path() / results / "manifest.json")).at("mesh").at("hash").dump();
  };
  EXPECT_EQ(mesh_of("outlets/cycle_1"), mesh_of("results"));
}

TEST(Tuning, KeepsTheBestWhereTheTargetsAreMissed) {
  const SharedFolder folder;
  folder.write("inflow.csv", inflow_table());
  const auto file = folder.write(
      "case.yaml", rigid_case("outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: "
                              "30 ms, max_cycles: 1, tolerance: 1e-6}\n"));
  EXPECT_NE(message_of<SolverError>([&] { tune(file); }).find("off by"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::exists(folder.path() / "outlets/best.yaml"));
  EXPECT_FALSE(fs::exists(folder.path() / "outlets/outlets.yaml"));
}

}  // namespace
}  // namespace tunica::test
