// Ends that nobody wishes for, and damaged files: each leaves a state from which the run goes on, and says so.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "program.hpp"

namespace tunica::test {
namespace {

const char* const conditions =
    "boundary: {lumen_inlet: {pressure: 100 Pa}, lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n";

class Endings : public Program {
 protected:
  void write_case(int steps, const std::string& output = "every: 2, checkpoint_every: 2",
                  const std::string& boundary = conditions) const {
    write("case.yaml", fmt::format("analysis: flow\nelements: linear\n"
                                   "meshes: {{tube: {{radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, "
                                   "cells_along: 5}}}}\n"
                                   "fluid: {{}}\noutput: {{{}}}\n{}time: {{step: 1 ms, steps: {}}}\n",
                                   output, boundary, steps));
  }
  /// A shell command in the folder, with the program as $T.
  int shell(const std::string& command) const {
    const std::string text = fmt::format("cd {} || exit 9; T={}; {}", folder_.string(), TUNICA_PROGRAM, command);
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/bash", "bash", "-c", text.c_str(), nullptr);
      _exit(127);
    }
    return exit_code(child);
  }
  void wait_for_line(const std::string& file, int lines) const {
    for (int k = 0; k < 3000; ++k) {
      const std::string text = read(file);
      if (std::count(text.begin(), text.end(), '\n') > lines) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  std::string status(const std::string& folder = "results") const {
    return nlohmann::json::parse(read(folder + "/manifest.json"))["runs"].back()["status"];
  }
  void expect_printed(const std::string& text) const {
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\nin\n" << printed();
  }
  void expect_same_as_whole(int steps, const std::string& results = "results") const {
    ASSERT_EQ(tunica("run case.yaml --output whole --overwrite"), 0) << printed();
    for (const std::string& file :
         {std::string("faces.csv"), std::string("balance.csv"), fmt::format("checkpoints/step_{:08}.checkpoint", steps),
          std::string("lumen.hdf.series")})
      EXPECT_TRUE(read(results + "/" + file) == read("whole/" + file)) << file;
  }
  static constexpr const char* last = "results/checkpoints/step_00000006.checkpoint";
  static constexpr const char* before = "results/checkpoints/step_00000004.checkpoint";
  void flip(const std::string& file, std::size_t from_end) const {
    std::string text = read(file);
    text[text.size() - from_end] ^= 4;
    write(file, text);
  }
  void cut(const std::string& file, double share) const {
    const std::string text = read(file);
    write(file, text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size()))));
  }
  /// The last line of what was printed that holds a command of the program, from "tunica" on.
  std::string command_printed() const {
    const std::string text = printed();
    const std::regex command("tunica (run|tune|prestress) case[^\n;]*");
    std::string found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), command); it != std::sregex_iterator(); ++it)
      found = it->str();
    return found.empty() ? found : found.substr(7);
  }
};

TEST_F(Endings, AHangUpLeavesACheckpoint) {
  write_case(1000000, "every: 1000000, checkpoint_every: 1000000");
  const pid_t child = start("run case.yaml");
  wait_for_line("results/steps.csv", 10);
  kill(child, SIGHUP);
  EXPECT_EQ(exit_code(child), 128 + SIGHUP) << printed();
  EXPECT_EQ(status(), "stopped");
  expect_printed("stopped by SIGHUP");
  EXPECT_FALSE(fs::is_empty(folder_ / "results/checkpoints"));
  EXPECT_EQ(tunica("run case.yaml --restart --until 1"), 0) << printed();
}

TEST_F(Endings, AnIgnoredHangUpDoesNotEndTheRun) {
  write_case(60);
  EXPECT_EQ(shell("(trap '' HUP; exec $T run case.yaml > out.txt 2>&1) & p=$!; "
                  "for k in $(seq 500); do [ -s results/steps.csv ] && break; sleep 0.02; done; kill -HUP $p; wait $p"),
            0)
      << printed();
  EXPECT_EQ(status(), "completed");
}

TEST_F(Endings, AReaderThatGoesAwayDoesNotEndTheRun) {
  write_case(6);
  EXPECT_EQ(shell("$T run case.yaml 2>&1 | head -n 2 > out.txt; exit ${PIPESTATUS[0]}"), 0) << printed();
  EXPECT_EQ(status(), "completed");
  EXPECT_NE(read("results/run.log").find("step 6/6"), std::string::npos);
  expect_same_as_whole(6);
}

TEST_F(Endings, StreamsThatAreClosedAtTheStartAreNotWrittenIntoResults) {
  write_case(6);
  EXPECT_EQ(shell("$T run case.yaml <&- >&- 2>&-"), 0);
  EXPECT_EQ(status(), "completed");
  expect_same_as_whole(6);
  const std::string log = read("results/run.log");
  EXPECT_EQ(log.find("\nstep 6/6"), std::string::npos) << log;
}

TEST_F(Endings, ATableThatEndsIsToldBeforeTheRun) {
  write("q.csv", "t,Q\n0,20\n0.0045,25\n");
  const std::string boundary =
      "boundary: {lumen_inlet: {flow: {table: {file: q.csv, time_unit: s, unit: ml/s, periodic: false}}}, "
      "lumen_outlet: {resistance: 1e8 Pa s/m^3}, lumen_wall: no_slip}\n";
  write_case(6, "every: 2", boundary);
  for (const char* command : {"check case.yaml", "run case.yaml"}) {
    EXPECT_EQ(tunica(command), 2) << printed();
    expect_printed("boundary.lumen_inlet");
    expect_printed("q.csv ends at 0.0045 s");
    expect_printed("at 0.006 s");
    EXPECT_FALSE(fs::exists(folder_ / "results"));
  }
  // As far as the table goes, and no further; what is there stays.
  EXPECT_EQ(tunica("run case.yaml --until 4"), 0) << printed();
  EXPECT_EQ(tunica("run case.yaml --restart --until 5"), 2) << printed();
  EXPECT_EQ(status(), "completed");
  EXPECT_TRUE(fs::exists(folder_ / before));
  write("q.csv", "t,Q\n0,20\n0.0045,25\n0.006,20\n");
  EXPECT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("run case.yaml --restart"), 0) << printed();
  // Cycles have an end, too.
  write("case.yaml", std::regex_replace(read("case.yaml"), std::regex("steps: 6"), "cycles: {period: 4 ms, most: 3}"));
  EXPECT_EQ(tunica("check case.yaml"), 2) << printed();
  expect_printed("3 cycles of 0.004 s");
}

TEST_F(Endings, ADamagedCheckpointFallsBackToTheOneBefore) {
  write_case(8);
  const std::vector<std::function<void()>> damages = {[&] { cut(last, 0.5); }, [&] { cut(last, 0.0); },
                                                      [&] { flip(last, 400); }, [&] { flip(last, 1); },
                                                      [&] { write(last, read(last) + "more"); }};
  for (const auto& damage : damages) {
    ASSERT_EQ(tunica("run case.yaml --overwrite --until 6"), 0) << printed();
    damage();
    EXPECT_EQ(tunica("run case.yaml --restart"), 0) << printed();
    expect_printed("warning: results/checkpoints/step_00000006.checkpoint: ");
    expect_printed("continuing from results/checkpoints/step_00000004.checkpoint after 4 steps");
    expect_same_as_whole(8);
  }
}

TEST_F(Endings, WithoutAWholeCheckpointTheNamedCommandWorks) {
  write_case(6);
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  cut(last, 0.3), flip(before, 50);
  EXPECT_EQ(tunica("run case.yaml --restart"), 2) << printed();
  expect_printed("no checkpoint that is whole");
  expect_printed("step_00000004.checkpoint: ");
  EXPECT_EQ(tunica(command_printed()), 0) << command_printed() << printed();
  expect_same_as_whole(6);

  flip(last, 50);
  EXPECT_EQ(tunica(std::string("run case.yaml --restart ") + last), 2) << printed();
  EXPECT_EQ(tunica(command_printed()), 0) << command_printed() << printed();
  fs::remove_all(folder_ / "results/checkpoints");
  EXPECT_EQ(tunica("run case.yaml --restart"), 2) << printed();
  EXPECT_EQ(tunica(command_printed()), 0) << command_printed() << printed();
}

TEST_F(Endings, LostLinesOfHistoriesAreNoticed) {
  write_case(8);
  ASSERT_EQ(tunica("run case.yaml --until 6"), 0) << printed();
  write("results/faces.csv", std::regex_replace(read("results/faces.csv"), std::regex("\n(3|4),[^\n]*"), ""));
  write("results/balance.csv",
        std::regex_replace(read("results/balance.csv"), std::regex("\n2,[^\n]*"), "\n2,nonsense"));
  EXPECT_EQ(tunica("run case.yaml --restart"), 0) << printed();
  expect_printed("warning: results/faces.csv: the lines of steps 3 to 4 are missing");
  expect_printed("warning: results/balance.csv:3: is no line of");
  expect_printed("warning: results/balance.csv: the line of step 2 is missing");
  EXPECT_EQ(read("results/faces.csv").find("\n3,"), std::string::npos);
  EXPECT_NE(read("results/faces.csv").find("\n8,"), std::string::npos);
}

TEST_F(Endings, AManifestThatIsGoneOrCutOffHidesNoResults) {
  write_case(8);
  const std::vector<std::function<void()>> damages = {[&] { cut("results/manifest.json", 0.4); },
                                                      [&] { write("results/manifest.json", ""); },
                                                      [&] { fs::remove(folder_ / "results/manifest.json"); }};
  for (const auto& damage : damages) {
    ASSERT_EQ(tunica("run case.yaml --overwrite --until 6"), 0) << printed();
    damage();
    EXPECT_EQ(tunica("run case.yaml"), 2) << printed();
    expect_printed("manifest.json is ");
    EXPECT_EQ(tunica("run case.yaml --restart"), 0) << printed();
    EXPECT_EQ(status(), "completed");
    expect_same_as_whole(8);
    damage();
    EXPECT_EQ(tunica("run case.yaml --overwrite"), 0) << printed();
  }
}

TEST_F(Endings, LostFieldsAreNoticed) {
  write_case(8);
  ASSERT_EQ(tunica("run case.yaml --until 6"), 0) << printed();
  fs::remove(folder_ / "results/lumen_000002.hdf");
  EXPECT_EQ(tunica("run case.yaml --restart"), 0) << printed();
  expect_printed("warning: lumen_000002.hdf of the series results/lumen.hdf.series is missing");
}

class ChainEndings : public Endings {
 protected:
  void write_chain(int steps, int flow_steps = 60) const {
    write("case.yaml",
          fmt::format("meshes:\n"
                      "  tube: {{radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 8, cells_radial: 1, "
                      "cells_along: 4}}\n"
                      "  interface: {{lumen: lumen_wall, wall: wall_inner}}\n"
                      "analysis: fsi\nelements: linear\nfluid: {{}}\n"
                      "wall: {{density: 1100 kg/m^3, material: {{neo_hooke: {{young_modulus: 0.4 MPa, poisson_ratio: "
                      "0.49}}}}}}\n"
                      "boundary:\n"
                      "  lumen_inlet: {{flow: 20 ml/s}}\n"
                      "  lumen_outlet: {{resistance: 5e8 Pa s/m^3}}\n"
                      "  \"wall_*\": fixed\n"
                      "  wall_outer: {{support: {{stiffness: 1e7 N/m^3}}}}\n"
                      "prestress: {{flow: {{pressure: 80 mmHg, inflow: 20 ml/s, step: 1 ms, steps: {}, tolerance: "
                      "1e-12}}, tolerance: 0.01 mm}}\n"
                      "report: {{pictures: false}}\n"
                      "time: {{step: 1 ms, steps: {}, rho_infinity: 0.2}}\n"
                      "output: {{directory: out, every: 2, checkpoint_every: 2}}\n",
                      flow_steps, steps));
  }
  std::string kept(const std::string& file) const { return read("kept/" + file); }
};

TEST_F(ChainEndings, AStageThatHasLostItsFilesIsNotFresh) {
  write_chain(6, 20);
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  fs::copy(folder_ / "out", folder_ / "kept", fs::copy_options::recursive);
  const auto fresh = [&](const char* stage) {
    EXPECT_EQ(tunica("run case.yaml --dry-run"), 0) << printed();
    return std::regex_search(printed(), std::regex(fmt::format("{} +fresh", stage)));
  };
  EXPECT_TRUE(fresh("prestress") && fresh("run") && fresh("report")) << printed();
  for (const std::string file : {"run/lumen_000004.hdf", "run/wall.hdf.series", "run/faces.csv",
                                 "run/checkpoints/step_00000006.checkpoint", "run/manifest.json"}) {
    fs::remove(folder_ / "out" / file);
    EXPECT_FALSE(fresh("run")) << file;
    EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
    EXPECT_TRUE(fresh("run"));
    EXPECT_TRUE(read("out/run/faces.csv") == kept("run/faces.csv")) << file;
    EXPECT_TRUE(read("out/run/wall.hdf.series") == kept("run/wall.hdf.series")) << file;
  }
  for (const std::string file : {"prestress/wall.vtu", "prestress/flow.checkpoint", "prestress/start.checkpoint"}) {
    cut("out/" + file, 0.6);
    EXPECT_FALSE(fresh("prestress")) << file;
    EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
    EXPECT_TRUE(read("out/" + file) == kept(file)) << file;
  }
}

TEST_F(ChainEndings, ADamagedCheckpointOfAnInterruptedStageIsPassedOver) {
  write_chain(8, 20);
  ASSERT_EQ(tunica("run case.yaml --until run"), 0) << printed();
  fs::copy(folder_ / "out", folder_ / "kept", fs::copy_options::recursive);
  const auto interrupted = [&] {
    auto record = nlohmann::json::parse(read("out/run/stage.json"));
    record["status"] = "running";
    write("out/run/stage.json", record.dump());
  };
  interrupted();
  cut("out/run/checkpoints/step_00000008.checkpoint", 0.5);
  ASSERT_EQ(tunica("run case.yaml --until run"), 0) << printed();
  expect_printed("continuing from");
  expect_printed("after 6 steps");
  for (const char* file : {"run/faces.csv", "run/checkpoints/step_00000008.checkpoint"})
    EXPECT_TRUE(read(std::string("out/") + file) == kept(file)) << file;
  interrupted();
  cut("out/run/checkpoints/step_00000008.checkpoint", 0.5);
  cut("out/run/checkpoints/step_00000006.checkpoint", 0.5);
  ASSERT_EQ(tunica("run case.yaml --until run"), 0) << printed();
  expect_printed("the run begins anew");
  EXPECT_TRUE(read("out/run/faces.csv") == kept("run/faces.csv"));
}

TEST_F(ChainEndings, ASteadyFlowGoesOnFromItsLastWholeState) {
  write_chain(2, 50);
  ASSERT_EQ(tunica("prestress case.yaml --output whole"), 0) << printed();
  fs::copy(folder_ / "whole", folder_ / "p", fs::copy_options::recursive);
  const auto again = [&](const std::string& says) {
    EXPECT_EQ(tunica("prestress case.yaml --output p --keep-flow"), 0) << printed();
    expect_printed(says);
    for (const char* file : {"/flow.checkpoint", "/wall.vtu", "/start.checkpoint"})
      EXPECT_TRUE(read(std::string("p") + file) == read(std::string("whole") + file)) << says << file;
  };
  flip("p/flow.checkpoint", 99);
  again("the steady flow goes on from p/flow_checkpoints/step_00000040.checkpoint");
  cut("p/flow.checkpoint", 0.2), cut("p/flow_checkpoints/step_00000040.checkpoint", 0.0);
  again("the steady flow goes on from p/flow_checkpoints/step_00000020.checkpoint");
  fs::remove(folder_ / "p/flow.checkpoint");
  for (const char* step : {"20", "40"}) cut(fmt::format("p/flow_checkpoints/step_000000{}.checkpoint", step), 0.5);
  again("the steady flow is computed anew");
}

TEST_F(ChainEndings, ASteadyFlowThatIsStoppedGoesOn) {
  write_chain(2, 100000);
  const pid_t child = start("prestress case.yaml --output p");
  for (int k = 0; k < 3000 && !fs::exists(folder_ / "p/flow_checkpoints/step_00000020.checkpoint"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGHUP);
  EXPECT_EQ(exit_code(child), 128 + SIGHUP) << printed();
  EXPECT_EQ(nlohmann::json::parse(read("p/prestress.json"))["status"], "stopped");
  const std::string command = command_printed();
  EXPECT_NE(command.find("--keep-flow"), std::string::npos) << printed();
  write("case.yaml", std::regex_replace(read("case.yaml"), std::regex("tolerance: 1e-12"), "tolerance: 0.5"));
  EXPECT_EQ(tunica(command), 0) << printed();
  expect_printed("the steady flow goes on from p/flow_checkpoints/step_");
}

}  // namespace
}  // namespace tunica::test
