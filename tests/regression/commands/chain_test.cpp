// `tunica run` on a case with several stages: what is done, what is reused, and that a chain which is killed anywhere
// comes to the result of one that was not.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "tube_case.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::test {
namespace {

class ChainCommand : public Program {
 protected:
  void write_case(const std::string& time, const std::string& output, const std::string& from = "",
                  const std::string& to = "") const {
    std::string text = std::string("title: Tube\n") + coarse_tube + prestressed_tube +
                       "post: {}\nreport: {pictures: false}\ntime: {step: 1 ms, steps: " + time +
                       ", rho_infinity: 0.2}\n" + "output: {" + output + "}\n";
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    write("case.yaml", text);
  }
  /// Cycles of the tube with a wall, the first of them to find the outlet.
  void write_tuned(const std::string& output) const {
    write("inflow.csv", "t,Q\n0,5\n0.1,5\n0.3,80\n0.5,5\n0.8,5\n");  // even about the start of a beat
    write("case.yaml", std::string(coarse_tube) +
                           "analysis: fsi\nelements: linear\nfluid: {}\n"
                           "wall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 0.4 MPa, poisson_ratio: "
                           "0.49}}}\n"
                           "boundary:\n"
                           "  lumen_inlet: {flow: {table: {file: inflow.csv, time_unit: s, unit: ml/s}}}\n"
                           "  \"wall_*\": fixed\n"
                           "  wall_outer: {support: {stiffness: 1e7 N/m^3}}\n"
                           "prestress: {flow: {pressure: 75 mmHg, inflow: 5 ml/s, step: 10 ms, steps: 20}, tolerance: "
                           "0.01 mm}\n"
                           "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: 10 "
                           "ms, tolerance: 0.1}\n"
                           "time: {step: 10 ms, steps: 20, rho_infinity: 0.2}\npost: {}\nreport: {pictures: false}\n"
                           "output: {directory: " +
                           output + "}\n");
  }
  void expect_printed(const std::string& text) const {
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\nin\n" << printed();
  }
  /// The folder of results after a kill by SIGKILL as soon as the file is there.
  void kill_when_there(const std::string& file) const {
    const pid_t child = start("run case.yaml");
    for (int k = 0; k < 6000 && !fs::exists(folder_ / file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, SIGKILL);
    EXPECT_EQ(exit_code(child), -SIGKILL) << printed();
  }
  void expect_same(const std::string& one, const std::string& other, const std::vector<std::string>& files) const {
    for (const auto& file : files) {
      EXPECT_FALSE(read(one + file).empty()) << file;
      EXPECT_TRUE(read(one + file) == read(other + file)) << file;
    }
  }
};

TEST_F(ChainCommand, ReusesWhatHasTheSameInputs) {
  write_case("3", "directory: out, every: 1");
  ASSERT_EQ(tunica("run case.yaml --dry-run"), 0) << printed();
  expect_printed("1/5 fibres     would be done: never done");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  ASSERT_EQ(tunica("run case.yaml --until prestress"), 0) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "out/run"));
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("=== stage 2/5: prestress (prestress of the imaged wall): reused");
  expect_printed("step 3/3");
  const std::string page = read("out/report/report.html");
  for (const char* text : {"<h1>Tube</h1>", "mean confidence", "TAWSS [Pa]", "iterations of the fixed point",
                           "Tuned outlets: the case has no stage", "Pictures: not wanted", "id=\"view3d\""})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(tunica("export case.yaml -o peer --units cgs --results"), 0) << "of the stage run\n" << printed();
  EXPECT_TRUE(fs::exists(folder_ / "peer/result_003.vtu")) << printed();
  const auto time = fs::last_write_time(folder_ / "out/run/faces.csv");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("run         reused");
  EXPECT_EQ(fs::last_write_time(folder_ / "out/run/faces.csv"), time);

  // Another spelling, other units of results and a title concern no stage, or only the run.
  write_case("3", "directory: out, units: {pressure: kPa}", "radius: 5 mm", "radius: 0.5 cm");
  ASSERT_EQ(tunica("run case.yaml --dry-run"), 0) << printed();
  expect_printed("2/5 prestress  fresh");
  expect_printed("3/5 run        would be done: inputs changed: output.units.pressure");
  // The wall's law does: the steady flow is kept.
  write_case("3", "directory: out", "k1: 60 kPa", "k1: 70 kPa");
  ASSERT_EQ(tunica("run case.yaml --until prestress"), 0) << printed();
  expect_printed("inputs changed: wall.material.hgo.families[1].k1; it goes on with what is there");
  expect_printed("steady flow: 20 steps");
  ASSERT_EQ(tunica("run case.yaml --from run"), 0) << printed();
  expect_printed("=== stage 3/5: run (the case itself): asked to be done anew");
  // A fibre angle comes before both.
  write_case("3", "directory: out", "outer: wall_outer, mean_angle: 35", "outer: wall_outer, mean_angle: 30");
  ASSERT_EQ(tunica("run case.yaml --dry-run"), 0) << printed();
  expect_printed("1/5 fibres     would be done: inputs changed: mean_angle");
  expect_printed("3/5 run        would be done: fibres comes before it");
}

TEST_F(ChainCommand, MoreStepsGoOn) {
  write_case("4", "directory: out");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  write_case("8", "directory: out");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("continuing from");
  EXPECT_EQ(printed().find("step 4/8"), std::string::npos) << printed();
  write_case("8", "directory: whole");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_same("out/run/", "whole/run/", {"faces.csv", "balance.csv", "checkpoints/step_00000008.checkpoint"});
}

TEST_F(ChainCommand, KilledAndStartedAgainItComesToTheSameResult) {
  write_case("30", "directory: whole, checkpoint_every: 2");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  write_case("30", "directory: out, checkpoint_every: 2");
  kill_when_there("out/prestress/flow.checkpoint");
  EXPECT_FALSE(fs::exists(folder_ / "out/prestress/start.checkpoint"));
  kill_when_there("out/run/checkpoints/step_00000004.checkpoint");
  EXPECT_EQ(nlohmann::json::parse(read("out/run/stage.json"))["status"], "running");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("=== stage 3/5: run (the case itself): it was interrupted");
  expect_printed("continuing from");
  expect_same("out/", "whole/",
              {"fibres/wall/mesh-complete.mesh.vtu", "prestress/wall.vtu", "prestress/start.checkpoint",
               "run/faces.csv", "run/balance.csv", "run/checkpoints/step_00000030.checkpoint"});
}

TEST_F(ChainCommand, KilledWhileOutletsAreTunedItComesToTheSameResult) {
  write_tuned("whole");
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  write_tuned("out");
  kill_when_there("out/outlets/probe/steps.csv");
  EXPECT_FALSE(fs::exists(folder_ / "out/outlets/cycle_1"));
  kill_when_there("out/outlets/cycle_1/steps.csv");
  EXPECT_EQ(nlohmann::json::parse(read("out/outlets/stage.json"))["status"], "running");
  EXPECT_FALSE(fs::exists(folder_ / "out/outlets/outlets.yaml"));
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  expect_printed("(outlets for the pressures and flows that are asked for): it was interrupted");
  expect_same("out/", "whole/", {"outlets/outlets.yaml", "run/faces.csv", "run/balance.csv"});
}

/// The run begins where the beat ended that the outlet was tuned by: its pressures go on the line of the last ones.
/// Variants that cannot begin there compute a beat first.
TEST_F(ChainCommand, RunGoesOnFromTheBeatThatTunedTheOutlets) {
  write_tuned("out");
  ASSERT_EQ(tunica("run case.yaml --until run"), 0) << printed();
  EXPECT_NE(read("out/run/case.yaml").find("start: ../outlets/start.checkpoint"), std::string::npos);
  const auto pressures = [&](const std::string& run) {
    return files::read_csv(folder_ / run / "faces.csv", "").column("lumen_outlet pressure [mmHg]");
  };
  const auto before = pressures("out/outlets/cycle_1"), after = pressures("out/run");
  ASSERT_EQ(before.size(), 80U);
  ASSERT_GE(after.size(), 20U);
  EXPECT_NEAR(after[0], 2 * before[79] - before[78], 0.05);
  EXPECT_NEAR(after[1], 3 * before[79] - 2 * before[78], 0.2);

  ASSERT_EQ(tunica("converge case.yaml --meshes 1 --steps 1 --quantity 'openings/*/pressure/mean_mmHg'"), 0)
      << printed();
  EXPECT_NE(read("out/converge/step_1/run/case.yaml").find("outlets/start.checkpoint"), std::string::npos);
  const std::string finer = read("out/converge/mesh_1/run/case.yaml");
  EXPECT_EQ(finer.find("outlets/start.checkpoint"), std::string::npos);
  EXPECT_NE(finer.find("steps: 100"), std::string::npos) << finer;
}

/// Without a state to go on from there is nothing to continue.
TEST_F(ChainCommand, ContinuedOutletsNeedAStart) {
  write_tuned("out");
  std::string text = read("case.yaml");
  text.replace(text.find("tolerance: 0.1}"), 15, "tolerance: 0.1, continued: true}");
  write("case.yaml", text);
  EXPECT_EQ(tunica("check case.yaml"), 2);
  expect_printed("outlets.continued");
}

TEST_F(ChainCommand, WallLawsSideBySide) {
  write_case("4", "directory: out, every: 1");
  EXPECT_EQ(tunica("compare case.yaml"), 2);
  expect_printed("names fewer than two laws");
  write("case.yaml", read("case.yaml") +
                         "compare:\n  soft: {material: {neo_hooke: {young_modulus: 0.4 MPa, poisson_ratio: 0.49}}}\n"
                         "  stiff: {material: {neo_hooke: {young_modulus: 0.8 MPa, poisson_ratio: 0.49}}}\n");
  ASSERT_EQ(tunica("compare case.yaml"), 0) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "out/run")) << "the law of the case itself is not asked for";
  // Under the same load the mean stress does not depend on the stiffness of one material, but for what is not yet
  // steady.
  std::istringstream table(read("out/compare/compare.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "what,unit,soft,stiff");
  std::getline(table, line);
  double soft = 0, stiff = 0;
  ASSERT_EQ(std::sscanf(line.c_str(), "wall first_principal_stress mean at peak pressure,kPa,%lf,%lf", &soft, &stiff),
            2)
      << line;
  EXPECT_NEAR(soft, stiff, 0.05 * stiff);
  EXPECT_NE(read("out/compare/compare.html").find("2: stiff"), std::string::npos);
  ASSERT_EQ(tunica("compare case.yaml"), 0) << printed();
  EXPECT_EQ(printed().find(": never done"), std::string::npos) << printed();
}

TEST_F(ChainCommand, WhatIsWrongIsToldBeforeAnyWork) {
  write("case.yaml",
        "analysis: fsi\nelements: linear\n"
        "mesh: {geometry: {parametric: {iliacs: {}}}, size: hug}\n"
        "fibres: {mean_angle: 35}\n"
        "fluid: {}\nboundary: {}\ntime: {step: 1 ms, steps: 2}\n");
  EXPECT_EQ(tunica("run case.yaml"), 2);
  for (const char* text : {"mesh.size", "fibres.mean_angle"}) expect_printed(text);
  write("case.yaml",
        "analysis: fsi\nelements: linear\n"
        "mesh: {geometry: {parametric: {iliacs: {}}}, size: coarse}\n"
        "fibres: {mean_angle: 35 deg, regions: {flop: {mean_angle: 20 deg}}}\n"
        "fluid: {}\n"
        "wall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.45}}}\n"
        "boundary: {lumen_inlet: {flow: 1 ml/s}, lumen_celiac: {resistance: 1e8 Pa s/m^3}, \"wall_*\": fixed, "
        "\"lid_*\": fixed}\n"
        "time: {step: 1 ms, steps: 2}\npost: {end: lumen_femoral}\n");
  for (const char* command : {"run case.yaml", "check case.yaml"}) {
    EXPECT_EQ(tunica(command), 2);
    for (const char* text :
         {"boundary.lumen_celiac: the mesh has no such face",
          "boundary.lumen_left_iliac: this lumen face has no condition", "boundary.lid_*: stands for no face",
          "fibres.regions.flop: the mesh will have no such region",
          "post.end: 'lumen_femoral' is no opening with a condition"})
      expect_printed(text);
  }
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  write_case("2", "directory: out");
  EXPECT_EQ(tunica("run case.yaml --until pestress"), 2);
  expect_printed("its stages: fibres, prestress, run, post, report");
  EXPECT_EQ(tunica("prestress case.yaml"), 2);
  expect_printed("fibres: is a stage to be done first");
}

}  // namespace
}  // namespace tunica::test
