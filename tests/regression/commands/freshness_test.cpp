// What `tunica run` takes as it is, what it does again and what it goes on with: by the contents of all that goes in,
// and wherever the folder lies.
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.hpp"

namespace tunica::test {
namespace {

class Freshness : public Program {
 protected:
  static constexpr const char* table =
      "boundary:\n  lumen_inlet: {flow: {table: {file: q.csv, time_unit: s, unit: ml/s}}}\n";
  static constexpr const char* tube =
      "{radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, cells_along: 4}";

  void expect_printed(const std::string& text) const {
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\nnot in\n" << printed();
  }
  void expect_not_printed(const std::string& text) const {
    EXPECT_EQ(printed().find(text), std::string::npos) << text << "\nin\n" << printed();
  }
  /// Flow through a rigid tube; `more` is the rest of the case, in the folder `a`.
  void write_flow(const std::string& more) const {
    fs::create_directories(folder_ / "a");
    write("a/q.csv", "t,Q\n0,5\n0.2,80\n0.4,5\n0.8,5\n");
    write("a/case.yaml",
          "analysis: flow\nelements: linear\nmeshes: {tube: {radius: 5 mm, length: 2 cm, cells_around: 8, "
          "cells_radial: 1, "
          "cells_along: 5}}\nfluid: {}\n" +
              std::string(table) + "  lumen_wall: no_slip\n" + more);
  }
  /// Blood and wall of a tube with all stages but outlets.
  void write_coupled(const std::string& stages) const {
    fs::create_directories(folder_ / "a");
    write("a/case.yaml",
          fmt::format(
              "title: Tube\nanalysis: fsi\nelements: linear\nmeshes: {{tube: {}, interface: {{lumen: lumen_wall, wall: "
              "wall_inner}}}}\nfluid: {{}}\n"
              "wall:\n  density: 1100 kg/m^3\n  material: {{neo_hooke: {{young_modulus: 0.4 MPa, poisson_ratio: "
              "0.49}}}}\n"
              "boundary:\n  lumen_inlet: {{flow: 20 ml/s}}\n  lumen_outlet: {{resistance: 5e8 Pa s/m^3}}\n"
              "  \"wall_*\": fixed\n  wall_outer: {{support: {{stiffness: 1e7 N/m^3}}}}\n"
              "time: {{step: 1 ms, steps: 3, rho_infinity: 0.2}}\noutput: {{every: 1}}\n",
              tube) +
              stages);
  }
  static constexpr const char* prestress =
      "prestress: {flow: {pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: 20}, tolerance: 0.01 mm}\n";
  static constexpr const char* fibres =
      "fibres: {inlet: [wall_inlet, lumen_inlet], outer: wall_outer, mean_angle: 35 deg}\n";
  int tunica_in(const fs::path& folder, const std::string& arguments) const {
    const std::string command = fmt::format("cd {} && exec {} {} > {} 2>&1", (folder_ / folder).string(),
                                            TUNICA_PROGRAM, arguments, (folder_ / "out.txt").string());
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void move_to(const std::string& name) const { fs::rename(folder_ / "a", folder_ / name); }
};

TEST_F(Freshness, ARestartNamesTheTableThatChanged) {
  write_flow(
      "  lumen_outlet: {resistance: 1e8 Pa s/m^3}\ntime: {step: 5 ms, steps: 6}\noutput: {checkpoint_every: 2}\n");
  ASSERT_EQ(tunica("run a/case.yaml --until 2"), 0) << printed();
  ASSERT_EQ(tunica("run a/case.yaml --restart --until 3"), 0) << printed();
  expect_not_printed("changed");
  write("a/q.csv", "t,Q\n0,5\n0.2,90\n0.4,5\n0.8,5\n");
  ASSERT_EQ(tunica("run a/case.yaml --restart"), 0) << printed();
  expect_printed(
      "changed since the checkpoint was written: q.csv (boundary.lumen_inlet.flow.table.file); the run goes on");
  EXPECT_EQ(tunica("run a/case.yaml"), 2);
  expect_printed("holds results of this case");
}

TEST_F(Freshness, AMovedFolderIsAsFreshAsBefore) {
  write_coupled(std::string(fibres) + prestress + "post: {}\nreport: {pictures: false}\n");
  ASSERT_EQ(tunica("run a/case.yaml --until prestress"), 0) << printed();
  move_to("b");
  ASSERT_EQ(tunica("run b/case.yaml"), 0) << printed();
  expect_printed("=== stage 2/5: prestress (prestress of the imaged wall): reused");
  fs::rename(folder_ / "b", folder_ / "c");
  ASSERT_EQ(tunica("run c/case.yaml --dry-run"), 0) << printed();
  expect_not_printed("would be done");
  EXPECT_EQ(read("c/results/run/case.yaml").find(folder_.string()), std::string::npos);
  EXPECT_EQ(read("c/results/run/stage.json").find(folder_.string()), std::string::npos);
}

TEST_F(Freshness, AnInterruptedTuningGoesOnAfterItsFolderWasMoved) {
  write_flow(
      "outlets: {systolic: 125 mmHg, diastolic: 75 mmHg, fractions: {lumen_outlet: 1}, step: 10 ms, tolerance: 0.1}\n"
      "time: {step: 10 ms, steps: 3}\n");
  const pid_t child = start("run a/case.yaml --until outlets");
  for (int k = 0; k < 6000 && !fs::exists(folder_ / "a/results/outlets/cycle_1/steps.csv"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGKILL);
  EXPECT_EQ(exit_code(child), -SIGKILL) << printed();
  move_to("b");
  ASSERT_EQ(tunica("run b/case.yaml --until outlets"), 0) << printed();
  expect_printed("it was interrupted");
  expect_printed("computed before");
  // By hand as well: nothing is left to be computed. A changed table is named.
  ASSERT_EQ(tunica("tune b/results/outlets/case.yaml"), 0) << printed();
  write("b/q.csv", "t,Q\n0,5\n0.2,90\n0.4,5\n0.8,5\n");
  EXPECT_EQ(tunica("tune b/results/outlets/case.yaml"), 2);
  expect_printed("before it was changed: q.csv (boundary.lumen_inlet.flow.table.file)");
}

TEST_F(Freshness, EverySectionIsDone) {
  write_coupled(std::string(prestress) + "post: {}\n");
  ASSERT_EQ(tunica("run a/case.yaml --dry-run"), 0) << printed();
  for (const char* stage : {"1/3 prestress", "2/3 run", "3/3 post"}) expect_printed(stage);
  ASSERT_EQ(tunica("run a/case.yaml"), 0) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "a/results/prestress/wall.vtu"));
  EXPECT_TRUE(fs::exists(folder_ / "a/results/post/post.json"));
  EXPECT_NE(read("a/results/run/case.yaml").find("../prestress/start.checkpoint"), std::string::npos);

  // A prestress that was found is named, and its stage is left out.
  auto text = read("a/case.yaml") + "start: results/prestress/start.checkpoint\n";
  write("a/case.yaml", text);
  EXPECT_EQ(tunica("run a/case.yaml --dry-run"), 2);
  expect_printed("start: is given, and the section `prestress` too");
  write("a/case.yaml", text.replace(text.find("  density"), 0, "  prestress: results/prestress/wall.vtu\n"));
  ASSERT_EQ(tunica("run a/case.yaml --dry-run"), 0) << printed();
  expect_printed("1/2 run        fresh");
}

TEST_F(Freshness, LawsToCompareAreASectionLikeOthers) {
  const std::string law = "{material: {neo_hooke: {young_modulus: 0.4 MPa, poisson_ratio: 0.49}}}";
  write_coupled("compare: {soft: " + law + "}\n");
  EXPECT_EQ(tunica("run a/case.yaml --dry-run"), 2);
  expect_printed("names fewer than two laws");
  write_coupled("compare: {soft: " + law + ", other: " + law + "}\n");
  ASSERT_EQ(tunica("run a/case.yaml --dry-run"), 0) << printed();
  expect_printed("then 2 laws side by side");
}

TEST_F(Freshness, CommandsOfTheGeneratedFilesExist) {
  write_coupled(std::string(fibres) + prestress + "post: {}\nreport: {pictures: false}\n");
  ASSERT_EQ(tunica("run a/case.yaml"), 0) << printed();
  const std::string mark = "# By hand, in this folder: tunica ";
  for (const char* file :
       {"fibres/fibres.yaml", "prestress/case.yaml", "run/case.yaml", "post/case.yaml", "report/report.yaml"}) {
    const fs::path path = fs::path("a/results") / file;
    const std::string text = read(path.string());
    const auto begin = text.find(mark);
    ASSERT_NE(begin, std::string::npos) << text;
    const auto command = text.substr(begin + mark.size(), text.find('\n', begin) - begin - mark.size());
    EXPECT_EQ(tunica_in(path.parent_path(), command), 0) << file << ": " << command << "\n" << printed();
  }
}

TEST_F(Freshness, PostAndReportTakeTheCaseOfAllStages) {
  write_coupled(std::string(fibres) + "report: {pictures: false}\n");
  EXPECT_EQ(tunica("post a/case.yaml"), 2);
  expect_printed("is missing: the stage fibres comes before post");
  ASSERT_EQ(tunica("run a/case.yaml"), 0) << printed();
  ASSERT_EQ(tunica("post a/case.yaml"), 0) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "a/results/post/post.json"));
  fs::remove(folder_ / "a/results/report/report.html");
  ASSERT_EQ(tunica("report a/case.yaml"), 0) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "a/results/report/report.html"));
  write_coupled("");
  EXPECT_EQ(tunica("report a/case.yaml"), 2);
  expect_printed("add `report: {}`");
}

TEST_F(Freshness, FiguresOfARunAloneAreMadeBesideIt) {
  write_coupled("");
  ASSERT_EQ(tunica("run a/case.yaml"), 0) << printed();
  write_coupled("post: {spacing: 5 mm}\n");
  ASSERT_EQ(tunica("post a/case.yaml"), 0) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "a/results/post/post.json"));
}

/// What is refused leaves everything as it was.
TEST_F(Freshness, ARefusedRunKeepsEarlierResults) {
  write_coupled("");
  ASSERT_EQ(tunica("run a/case.yaml"), 0) << printed();
  const std::string before = read("a/results/faces.csv");
  write_coupled("start: q.checkpoint\n");
  EXPECT_EQ(tunica("run a/case.yaml --overwrite"), 2);
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(read("a/results/faces.csv"), before);
}

TEST_F(Freshness, DirectionsMadeByTheirOwnCommandAreTaken) {
  write_coupled("fibres: {inlet: [wall_inlet, lumen_inlet], outer: wall_outer, mean_angle: 35 deg, output: own}\n");
  write("a/fibres.yaml", fmt::format("meshes: {{tube: {}, interface: {{lumen: lumen_wall, wall: wall_inner}}}}\n"
                                     "inlet: [wall_inlet, lumen_inlet]\nouter: wall_outer\nmean_angle: {{}} deg\n",
                                     tube));
  auto text = read("a/fibres.yaml");
  const auto with_angle = [&](const char* angle) {
    auto file = text;
    write("a/fibres.yaml", file.replace(file.find("{}"), 2, angle));
  };
  with_angle("35");
  ASSERT_EQ(tunica("fibres a/fibres.yaml -o a/own"), 0) << printed();
  ASSERT_EQ(tunica("run a/case.yaml --dry-run"), 0) << printed();
  expect_printed("1/2 fibres     fresh");
  with_angle("30");
  ASSERT_EQ(tunica("fibres a/fibres.yaml -o a/own --overwrite"), 0) << printed();
  ASSERT_EQ(tunica("run a/case.yaml --dry-run"), 0) << printed();
  expect_printed("1/2 fibres     would be done: inputs changed: mean_angle");
}

}  // namespace
}  // namespace tunica::test
