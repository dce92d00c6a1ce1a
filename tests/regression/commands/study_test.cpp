// `tunica study` on a short tube: points, what they share, what an interruption leaves, points that fail, bad input.
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "tube_case.hpp"

namespace tunica::test {
namespace {

class StudyCommand : public Program {
 protected:
  void write_case(const std::string& more = "post: {}\n", int steps = 3) const {
    write("case.yaml", fmt::format("title: Tube\nanalysis: flow\n"
                                   "meshes: {{tube: {{radius: 5 mm, length: 20 mm, cells_around: 8, cells_radial: 1, "
                                   "cells_along: 4}}}}\n"
                                   "fluid: {{}}\n"
                                   "boundary: {{lumen_inlet: {{flow: 20 ml/s}}, lumen_outlet: {{resistance: 5e7 Pa "
                                   "s/m^3}}, lumen_wall: no_slip}}\n"
                                   "time: {{step: 4 ms, steps: {}, rho_infinity: 0.2}}\n"
                                   "output: {{directory: results, checkpoint_every: 4}}\n",
                                   steps) +
                           more);
  }
  void write_study(const std::string& text) const { write("study.yaml", "case: case.yaml\n" + text); }
  nlohmann::json results() const { return nlohmann::json::parse(read("study/study.json")); }

  /// study.csv without its seconds, which no two computations share.
  std::string table() const {
    std::istringstream lines(read("study/study.csv"));
    std::string all, line;
    while (std::getline(lines, line)) {
      const auto error = line.rfind(','), seconds = line.rfind(',', error - 1);
      all += line.substr(0, seconds) + "\n";
    }
    return all;
  }
  bool wait_for(const std::string& file) const {
    for (int k = 0; k < 600 && !fs::exists(folder_ / file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return fs::exists(folder_ / file);
  }
  fs::file_time_type made(const std::string& file) const { return fs::last_write_time(folder_ / file); }
};

constexpr const char* two_keys =
    "vary:\n"
    "  boundary.lumen_inlet.flow: [20 ml/s, 40 ml/s]\n"
    "  meshes/tube/length: {from: 20 mm, to: 30 mm, count: 2}\n"
    "quantities: 'openings/*/pressure/mean_mmHg'\n";

constexpr const char* inlet_pressure = "openings/lumen_inlet/pressure/mean_mmHg";

TEST_F(StudyCommand, GivesATableAndTakesItAgain) {
  write_case();
  write_study(two_keys);
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  const auto first = results();
  ASSERT_EQ(first["points"].size(), 4U);
  EXPECT_EQ(first["points"][1]["values"]["meshes.tube.length"], "30 mm");
  EXPECT_EQ(first["keys"][0]["unit"], "ml/s");
  const auto pressure = [&](int k) { return first["points"][k]["quantities"][inlet_pressure].get<double>(); };
  // The outlet's resistance is most of what the flow meets; the longer tube has more of its own.
  EXPECT_NEAR(pressure(2) / pressure(0), 2, 0.3);
  EXPECT_GT(pressure(1), pressure(0));
  EXPECT_NE(read("study/study.html").find("<svg"), std::string::npos);
  EXPECT_NE(read("study/point_0003/case.yaml").find("40 ml/s"), std::string::npos);

  // As the case itself has it, with the same values.
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  const auto post = nlohmann::json::parse(read("results/post/post.json"));
  for (const auto& opening : post["openings"]) {
    if (opening["name"] != "lumen_inlet") continue;
    EXPECT_DOUBLE_EQ(opening["pressure"]["mean_mmHg"].get<double>(), pressure(0));
  }

  const std::string before = read("study/study.csv");
  const auto run = made("study/point_0002/run/manifest.json");
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  EXPECT_EQ(read("study/study.csv"), before);
  EXPECT_EQ(made("study/point_0002/run/manifest.json"), run);

  fs::remove_all(folder_ / "study/point_0002/run");
  const std::string lines = table();
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  EXPECT_EQ(table(), lines);
}

TEST_F(StudyCommand, GoesOnAfterSigkillWithTheSameTable) {
  write_case("post: {}\n", 12);
  write_study(two_keys);
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  const std::string whole = table();
  fs::remove_all(folder_ / "study");
  const pid_t child = start("study study.yaml");
  ASSERT_TRUE(wait_for("study/point_0002/run/manifest.json")) << printed();
  kill(child, SIGKILL);
  ASSERT_EQ(exit_code(child), -SIGKILL) << printed();
  const auto done = made("study/point_0001/post/post.json");
  EXPECT_FALSE(fs::exists(folder_ / "study/study.csv"));
  ASSERT_EQ(tunica("study study.yaml --table"), 0) << printed();
  EXPECT_NE(printed().find("pending"), std::string::npos) << printed();
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  EXPECT_EQ(table(), whole);
  EXPECT_EQ(made("study/point_0001/post/post.json"), done);
}

TEST_F(StudyCommand, DoesSinglePointsOfAnArray) {
  write_case();
  write_study(two_keys);
  ASSERT_EQ(tunica("study study.yaml --dry-run"), 0) << printed();
  EXPECT_NE(printed().find("point 4 (boundary.lumen_inlet.flow = 40 ml/s, meshes.tube.length = 30 mm): pending"),
            std::string::npos)
      << printed();
  EXPECT_FALSE(fs::exists(folder_ / "study/point_0001/run"));
  ASSERT_EQ(tunica("study study.yaml --point 3"), 0) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "study/point_0001/run"));
  EXPECT_FALSE(fs::exists(folder_ / "study/study.csv"));
  ASSERT_EQ(tunica("study study.yaml --table"), 0) << printed();
  EXPECT_NE(printed().find("4 points: 1 done, 3 pending"), std::string::npos) << printed();
  EXPECT_EQ(results()["points"][2]["status"], "done");
  EXPECT_EQ(tunica("study study.yaml --point 5"), 2);
  EXPECT_NE(printed().find("give one from 1 to 4"), std::string::npos) << printed();
}

// The inflow of the run is none of the steady flow's under the prestress, and the support none of the directions'.
TEST_F(StudyCommand, DoesStagesOnceThatPointsHaveInCommon) {
  write("case.yaml", std::string("title: Tube\n") + coarse_tube + prestressed_tube +
                         "time: {step: 1 ms, steps: 4, rho_infinity: 0.2}\npost: {}\n");
  write_study(
      "vary: {boundary.wall_outer.support.stiffness: [1e7 N/m^3, 2e7 N/m^3], boundary.lumen_inlet.flow: [20 ml/s, 30 "
      "ml/s]}\n"
      "quantities: '*mmHg*'\n");
  ASSERT_EQ(tunica("study study.yaml --shared"), 0) << printed();
  for (const char* done : {"fibres_0001/meshes.yaml", "prestress_0001/wall.vtu", "prestress_0003/wall.vtu"})
    EXPECT_TRUE(fs::exists(folder_ / "study/shared" / done)) << done;
  EXPECT_FALSE(fs::exists(folder_ / "study/shared/prestress_0002"));
  EXPECT_FALSE(fs::exists(folder_ / "study/point_0001/run"));
  const auto prestress = made("study/shared/prestress_0001/stage.json");
  ASSERT_EQ(tunica("study study.yaml --point 2"), 0) << printed();
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  EXPECT_EQ(made("study/shared/prestress_0001/stage.json"), prestress);
  EXPECT_EQ(printed().find("inputs changed"), std::string::npos) << printed();
  EXPECT_NE(printed().find("4 points: 4 done"), std::string::npos) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "study/point_0001/prestress"));

  // As a chain that shares nothing finds it.
  const auto shared = nlohmann::json::parse(read("study/point_0001/post/post.json"));
  ASSERT_EQ(tunica("run case.yaml"), 0) << printed();
  EXPECT_EQ(nlohmann::json::parse(read("results/post/post.json"))["openings"], shared["openings"]);
}

TEST_F(StudyCommand, RecordsAPointThatFailsAndGoesOn) {
  write_case();
  // One iteration of Newton's method does not do for so tight a tolerance, and no halving is allowed.
  write_study(
      "vary: {newton.max_iterations: [1, 20], time.max_halvings: [0, 3]}\ndesign: list\n"
      "quantities: ['openings/*/pressure/mean_mmHg', 'no/such/figure']\n");
  EXPECT_EQ(tunica("study study.yaml"), 3) << printed();
  EXPECT_NE(printed().find("2 points: 1 done, 1 failed"), std::string::npos) << printed();
  EXPECT_NE(printed().find("`no/such/figure` fits no figure"), std::string::npos) << printed();
  const auto found = results();
  EXPECT_EQ(found["points"][0]["status"], "failed");
  EXPECT_NE(found["points"][0]["error"].get<std::string>().find("stage run"), std::string::npos);
  EXPECT_EQ(found["points"][1]["status"], "done");
  EXPECT_NE(read("study/study.csv").find(",nan,"), std::string::npos);
}

TEST_F(StudyCommand, SampledDesignsTellWhatMatters) {
  write_case();
  write_study(
      "vary: {boundary.lumen_inlet.flow: {between: [20 ml/s, 60 ml/s]}, time.rho_infinity: {between: [0.2, 0.21]}}\n"
      "design: {sobol: {points: 4}}\nquantities: 'openings/lumen_inlet/pressure/mean_mmHg'\n");
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  EXPECT_DOUBLE_EQ(results()["rank_correlation"][inlet_pressure]["boundary.lumen_inlet.flow"], 1);
  write_study(
      "vary: {boundary.lumen_inlet.flow: {between: [20 ml/s, 60 ml/s]}, time.rho_infinity: {between: [0.2, 0.21]}}\n"
      "design: {saltelli: {points: 4}}\nquantities: 'openings/lumen_inlet/pressure/mean_mmHg'\noutput: indices\n");
  ASSERT_EQ(tunica("study study.yaml"), 0) << printed();
  const auto found = nlohmann::json::parse(read("indices/study.json"))["sobol_indices"][inlet_pressure];
  EXPECT_GT(found["boundary.lumen_inlet.flow"]["total"], 0.5);
  EXPECT_LT(found["time.rho_infinity"]["total"], 0.01);
}

TEST_F(StudyCommand, SaysWhatIsWrongBeforeAnyWork) {
  write_case();
  const auto refuses = [&](const std::string& text, const std::string& part) {
    write_study(text);
    EXPECT_EQ(tunica("study study.yaml"), 2) << printed();
    EXPECT_NE(printed().find(part), std::string::npos) << printed();
    EXPECT_FALSE(fs::exists(folder_ / "study/point_0001/run"));
  };
  refuses("vary: {fluid.densty: [1000 kg/m^3]}\n", "did you mean `density`?");
  refuses("vary: {fluid.density: [1000 kg/m^3, -1 kg/m^3]}\n", "point 2 (fluid.density = -1 kg/m^3): fluid.density");
  refuses("vary: {fluid.density: [1000, 1100]}\n", "has no unit");
  refuses("vary: {fluid.density: [1 g/cm^3, 1100 kg/m^3]}\n", "has values in different units");
  refuses("vary: {fluid.density.of.what: [1 g/cm^3]}\n", "fluid.density");
  refuses("vary: {fluid.density: [1 g/cm^3, 1 g/cm^3]}\n", "is point 1 again");
  refuses("vary: {boundary.lumen_inlt.flow: [1 ml/s]}\n", "lumen_inlt");
  write_case("");
  refuses("vary: {fluid.density: [1000 kg/m^3]}\n", "add `post: {}`");
  EXPECT_EQ(tunica("study nothing.yaml"), 2);
}

}  // namespace
}  // namespace tunica::test
