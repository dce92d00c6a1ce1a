// The program itself: exit codes, and a run that is killed from outside.
#include <signal.h>

#include <chrono>
#include <thread>
#include <vector>

#include "program.hpp"

namespace tunica::test {
namespace {

class RunCommand : public Program {
 protected:
  void write_case(const std::string& more) const {
    std::ofstream(folder_ / "case.yaml")
        << "analysis: flow\nelements: linear\n"
           "meshes: {tube: {radius: 5 mm, length: 2 cm, cells_around: 8, cells_radial: 1, cells_along: 5}}\n"
           "fluid: {}\n"
           "output: {every: 100, checkpoint_every: 100}\n"
        << more;
  }
  pid_t start_run(const std::string& arguments) const { return start("run case.yaml " + arguments); }
  int run(const std::string& arguments) const { return exit_code(start_run(arguments)); }
};

const std::string sound =
    "boundary: {lumen_inlet: {pressure: 100 Pa}, lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n"
    "time: {step: 1 ms, steps: 6}\n";

TEST_F(RunCommand, ZeroWhenDone) {
  write_case(sound);
  EXPECT_EQ(run(""), 0) << printed();
  for (const char* told : {"step 6/6", "ETA 0:00", "whole run: least, mean, largest", "  lumen_outlet "})
    EXPECT_NE(printed().find(told), std::string::npos) << told << printed();
  EXPECT_EQ(printed().find("newton"), std::string::npos) << printed();
  EXPECT_NE(slurp(folder_ / "results/run.log").find("newton"), std::string::npos);
  EXPECT_EQ(printed().find('\033'), std::string::npos) << "colours in a file";
  EXPECT_EQ(run("--overwrite --verbose"), 0) << printed();
  EXPECT_NE(printed().find("newton"), std::string::npos) << printed();
  EXPECT_NE(slurp(folder_ / "results/manifest.json").find("\"commit\""), std::string::npos);
}

TEST_F(RunCommand, TwoForWrongInputWhichIsReportedAtOnce) {
  write_case("boundary: {lumen_inlt: {pressure: 100 Pa}, lumen_wall: no_slip}\ntime: {step: 1 ms, steps: 6}\n");
  EXPECT_EQ(run(""), 2);
  EXPECT_NE(printed().find("did you mean 'lumen_inlet'"), std::string::npos) << printed();
  EXPECT_NE(printed().find("boundary.lumen_outlet: this lumen face has no condition"), std::string::npos) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  EXPECT_EQ(run("--no-such-option"), 2);
}

TEST_F(RunCommand, TwoWhenResultsAreThere) {
  write_case(sound);
  EXPECT_EQ(run("--until 1"), 0);
  EXPECT_EQ(run(""), 2);
  EXPECT_NE(printed().find("--overwrite"), std::string::npos) << printed();
  EXPECT_EQ(run("--overwrite --until 1"), 0) << printed();
}

TEST_F(RunCommand, ThreeWhenTheComputationFails) {
  write_case(sound + "newton: {max_iterations: 1, relative_tolerance: 1e-13}\nlinear: {tolerance: 0.1}\n");
  EXPECT_EQ(run(""), 3) << printed();
  EXPECT_NE(printed().find("last checkpoint:"), std::string::npos) << printed();
}

// SIGTERM from outside, and SIGKILL, which leaves what the last checkpoint holds.
TEST_F(RunCommand, AKilledRunContinues) {
  const std::string endless =
      "boundary: {lumen_inlet: {pressure: 100 Pa}, lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n"
      "time: {step: 1 ms, steps: 1000000}\n";
  write_case(endless);
  for (const int signal : {SIGTERM, SIGKILL}) {
    const auto results = folder_ / fmt::format("by_{}", signal);
    const pid_t child = start_run("--output " + results.string());
    const fs::path awaited = results / (signal == SIGKILL ? "checkpoints/step_00000100.checkpoint" : "steps.csv");
    for (int k = 0; k < 3000 && !fs::exists(awaited); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(child, signal);
    EXPECT_EQ(exit_code(child), signal == SIGKILL ? -SIGKILL : 128 + SIGTERM) << printed();
    std::int64_t reached = 0;
    for (const auto& entry : fs::directory_iterator(results / "checkpoints"))
      if (entry.path().extension() == ".checkpoint")
        reached = std::max<std::int64_t>(reached, std::stoll(entry.path().filename().string().substr(5)));
    const auto last = reached + 3;
    EXPECT_EQ(run(fmt::format("--output {} --restart --until {}", results.string(), last)), 0) << printed();
    EXPECT_EQ(run(fmt::format("--output whole_{} --until {}", signal, last)), 0) << printed();
    for (const std::string& file :
         std::vector<std::string>{"faces.csv", "balance.csv", fmt::format("checkpoints/step_{:08}.checkpoint", last)})
      EXPECT_TRUE(slurp(results / file) == slurp(folder_ / fmt::format("whole_{}", signal) / file)) << file;
  }
}

}  // namespace
}  // namespace tunica::test
