// `tunica identify` on a short tube: a modulus that is known, an interruption, runs that fail, bad input.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "tube_case.hpp"

namespace tunica::test {
namespace {

class IdentifyCommand : public Program {
 protected:
  static std::string tube(const std::string& modulus) {
    return fmt::format(
        "title: Tube\n{}analysis: fsi\nelements: linear\nfluid: {{}}\n"
        "wall:\n"
        "  density: 1100 kg/m^3\n"
        "  material: {{neo_hooke: {{young_modulus: {}, poisson_ratio: 0.45}}}}\n"
        "boundary:\n"
        "  lumen_inlet: {{flow: {{value: 40 ml/s, ramp_time: 8 ms}}}}\n"
        "  lumen_outlet: {{resistance: 3e8 Pa s/m^3}}\n"
        "  \"wall_*\": fixed\n"
        "  wall_outer: {{support: {{stiffness: 1e7 N/m^3}}}}\n"
        "time: {{step: 2 ms, steps: 10, rho_infinity: 0.2}}\n"
        "output: {{directory: results, points: {{side: [5 mm, 0 mm, 10 mm]}}}}\n",
        coarse_tube, modulus);
  }
  /// `column` of middle.csv is the course of the area; the point's distances are in mm.
  static std::string measured(const std::string& column, double largest, double mean) {
    return fmt::format(
        "post: {{}}\n"
        "measured:\n"
        "  areas: {{middle: {{plane: {{centre: [0 mm, 0 mm, 10 mm], normal: [0, 0, 1]}}, curve: {{file: middle.csv, "
        "value_column: \"{}\", time_unit: s, unit: mm^2}}, uncertainty: 0.2 mm^2}}}}\n"
        "  displacements: {{side: {{point: side, largest: {:.9g} mm, mean: {:.9g} mm, uncertainty: 0.01 mm}}}}\n",
        column, largest, mean);
  }
  /// The tube with 400 kPa, and a case that starts from half of that and was measured in it.
  void write_case() const {
    write("middle.csv", "time,area\n0,80\n0.004,80\n0.008,80\n0.012,80\n0.016,80\n0.019,80\n");
    write("truth.yaml", tube("400 kPa") + measured("area", 1, 0.5));
    ASSERT_EQ(tunica("run truth.yaml"), 0) << printed();
    const auto rows = nlohmann::json::parse(read("results/post/post.json"))["measured"][1]["rows"];
    write("middle.csv", read("results/post/measured_middle.csv"));
    write("case.yaml", tube("200 kPa") + measured("computed [mm^2]", rows[0]["computed"], rows[1]["computed"]));
  }
  void write_identify(const std::string& text) const { write("identify.yaml", "case: case.yaml\n" + text); }
  nlohmann::json found() const { return nlohmann::json::parse(read("identify/identify.json")); }

  /// identify.csv without its seconds, which no two computations share.
  std::string table() const {
    std::istringstream lines(read("identify/identify.csv"));
    std::string all, line;
    while (std::getline(lines, line)) {
      const auto error = line.rfind(','), seconds = line.rfind(',', error - 1);
      all += line.substr(0, seconds) + "\n";
    }
    return all;
  }
};

constexpr const char* modulus =
    "parameters: {wall: {keys: wall.material.neo_hooke.young_modulus, between: [0.05 MPa, 4 MPa]}}\n";

TEST_F(IdentifyCommand, FindsTheModulusAndGoesOn) {
  write_case();
  write_identify(modulus);
  ASSERT_EQ(tunica("identify identify.yaml --dry-run"), 0) << printed();
  EXPECT_NE(printed().find("wall: starts at 0.2 MPa, between 0.05 MPa and 4 MPa"), std::string::npos) << printed();
  EXPECT_NE(printed().find("areas/middle: a curve, counts for 6 values"), std::string::npos) << printed();
  EXPECT_FALSE(fs::exists(folder_ / "identify/run_0001/run"));

  // Killed in the second run.
  const pid_t child = start("identify identify.yaml");
  for (int k = 0; k < 600 && !fs::exists(folder_ / "identify/run_0002/run/manifest.json"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(child, SIGKILL);
  ASSERT_EQ(exit_code(child), -SIGKILL) << printed();
  const auto first_run = fs::last_write_time(folder_ / "identify/run_0001/run/manifest.json");
  EXPECT_FALSE(fs::exists(folder_ / "identify/identify.csv"));

  ASSERT_EQ(tunica("identify identify.yaml"), 0) << printed();
  EXPECT_EQ(fs::last_write_time(folder_ / "identify/run_0001/run/manifest.json"), first_run);
  const auto result = found();
  EXPECT_EQ(result["converged"], true);
  EXPECT_EQ(result["runs"][1]["purpose"], "difference of wall");
  EXPECT_LE(result["runs"].size(), 8U);
  const auto& wall = result["parameters"][0];
  EXPECT_NEAR(wall["value"].get<double>(), 0.4, 0.02 * 0.4);
  EXPECT_LT(wall["interval_95"][0], 0.4);
  EXPECT_GT(wall["interval_95"][1], 0.4);
  EXPECT_TRUE(result["undetermined"].empty()) << result["undetermined"];
  EXPECT_LT(result["misfit"]["end"].get<double>(), 0.05 * result["misfit"]["start"].get<double>());
  const std::string page = read("identify/identify.html");
  for (const char* part : {"areas/middle", "best run", "95 % interval", "Misfit"})
    EXPECT_NE(page.find(part), std::string::npos) << part;

  // The same once the last run is lost, and as long as nothing is.
  const std::string lines = table(), identified = read("identify/identified.yaml");
  fs::remove_all(folder_ / fmt::format("identify/run_{:04}", result["runs"].size()));
  ASSERT_EQ(tunica("identify identify.yaml"), 0) << printed();
  EXPECT_EQ(table(), lines);
  EXPECT_EQ(read("identify/identified.yaml"), identified);

  // The case that was found is the last run, and its results are its own.
  ASSERT_EQ(tunica("run identify/identified.yaml"), 0) << printed();
  EXPECT_NE(printed().find("side largest [mm]"), std::string::npos) << printed();
  EXPECT_EQ(printed().find("differs"), std::string::npos) << printed();
  EXPECT_TRUE(fs::exists(folder_ / "identify/identified/post/post.json"));
}

// Modulus and support both hold the wall: nearly one combination of them is all that the tube tells.
TEST_F(IdentifyCommand, SaysWhatIsNotDetermined) {
  write_case();
  write_identify(
      "parameters:\n"
      "  wall: {factor_on: wall.material.neo_hooke.young_modulus, between: [0.1, 10]}\n"
      "  support: {keys: boundary/wall_outer/support/stiffness, between: [1e6 N/m^3, 1.02e7 N/m^3]}\n"
      "  outlet: {keys: wall.density, between: [1000 kg/m^3, 1200 kg/m^3]}\n"
      "measurements: 'areas/*'\nmax_runs: 5\n");
  EXPECT_EQ(tunica("identify identify.yaml"), 3) << printed();
  EXPECT_NE(printed().find("Not converged after 5 runs"), std::string::npos) << printed();
  EXPECT_NE(printed().find("wall and support are hardly told apart"), std::string::npos) << printed();
  EXPECT_NE(printed().find("outlet is not determined by these measurements"), std::string::npos) << printed();
  EXPECT_NE(read("identify/run_0001/case.yaml").find("young_modulus: 200 kPa"), std::string::npos);
  EXPECT_EQ(found()["converged"], false);
  EXPECT_EQ(found()["measurements"].size(), 1U);
}

TEST_F(IdentifyCommand, ARunThatFailsShortensTheStep) {
  write_case();
  write_identify(modulus);
  fs::create_directories(folder_ / "identify/run_0003");
  write("identify/run_0003/run", "no folder\n");
  ASSERT_EQ(tunica("identify identify.yaml"), 0) << printed();
  const auto runs = found()["runs"];
  EXPECT_EQ(runs[2]["status"], "failed");
  EXPECT_NE(read("identify/identify.csv").find("nan,0,failed,"), std::string::npos) << read("identify/identify.csv");
  const auto value = [&](int k) { return runs[k]["values"]["wall"].get<double>(); };
  const double shortened = std::log(value(3) / value(0)) / std::log(value(2) / value(0));
  EXPECT_LE(shortened, 0.334);
  EXPECT_GT(shortened, 0.1);
  EXPECT_NEAR(found()["parameters"][0]["value"].get<double>(), 0.4, 0.02 * 0.4);

  // Two iterations of Newton's method do not do, and no halving is allowed.
  write("case.yaml", std::regex_replace(read("case.yaml"), std::regex("rho_infinity: 0.2\\}"),
                                        "rho_infinity: 0.2, max_halvings: 0}\nnewton: {max_iterations: 2}"));
  EXPECT_EQ(tunica("identify identify.yaml -o other"), 3) << printed();
  EXPECT_NE(printed().find("the first run, wall = 0.2 MPa, failed"), std::string::npos) << printed();
}

TEST_F(IdentifyCommand, SaysWhatIsWrongBeforeAnyWork) {
  write("middle.csv", "time,area\n0,80\n0.01,80\n");
  write("case.yaml", tube("200 kPa") + measured("area", 1, 0.5));
  const auto refuses = [&](const std::string& text, const std::string& part) {
    write_identify(text);
    EXPECT_EQ(tunica("identify identify.yaml --dry-run"), 2) << printed();
    EXPECT_NE(printed().find(part), std::string::npos) << printed();
    EXPECT_FALSE(fs::exists(folder_ / "identify"));
  };
  const auto one = [](const std::string& parameter) { return "parameters: {stiff: {" + parameter + "}}\n"; };
  const std::string key = "keys: wall.material.neo_hooke.young_modulus, ";
  refuses("parameters: {}\n", "names none");
  refuses(one("between: [0.1 MPa, 1 MPa]"), "names no key");
  refuses(one("keys: wall.material.neo_hooke.young_modulos, between: [0.1 MPa, 1 MPa]"), "did you mean");
  refuses(one(key + "between: [0.1, 1]"), "parameters.stiff = 0.1: wall.material.neo_hooke.young_modulus");
  refuses(one(key + "between: [0.1 MPa, 1000 kPa]"), "is not in the unit of the others");
  refuses(one(key + "between: [1 MPa, 0.1 MPa]"), "is not above `1 MPa`");
  refuses(one(key + "between: [0 MPa, 1 MPa]"), "is not above 0");
  refuses(one(key + "between: [0.3 MPa, 1 MPa]"), "is 0.2 MPa, not between 0.3 MPa and 1 MPa");
  refuses(one(key + "between: [0.1 MPa, 1 MPa], start: 2 MPa"), "is 2 MPa, not between");
  refuses(one("factor_on: wall.material.neo_hooke.shear_modulus, between: [0.5, 2]"), "the case has no number at");
  refuses(one("keys: measured.areas.middle.uncertainty, between: [0.1 mm^2, 9 mm^2]"), "is no property of the patient");
  refuses(one("keys: title, between: [1, 2]"), "is no single number");
  refuses(one("keys: [wall.density, wall.material.neo_hooke.poisson_ratio], between: [0.1, 0.4]"), "wall.density");
  refuses(one(key + "between: [0.1 MPa, 1 MPa]") + "measurements: 'flows/*'\n", "`flows/*` fits none");
  refuses(one(key + "between: [0.1 MPa, 1 MPa]") + "max_runs: 0\n", "max_runs");
  refuses(
      "parameters:\n"
      "  a: {keys: wall.density, between: [900 kg/m^3, 1200 kg/m^3]}\n"
      "  b: {keys: wall.material.neo_hooke.young_modulus, between: [0.1 MPa, 1 MPa]}\n"
      "  c: {keys: boundary.wall_outer.support.stiffness, between: [1e6 N/m^3, 1e8 N/m^3]}\n"
      "measurements: 'displacements/*'\n",
      "are 3, more than the 2 measured values");
  write("case.yaml", tube("200 kPa") + "post: {}\n");
  refuses(modulus, "has no section `measured`");
  write("case.yaml", tube("200 kPa"));
  refuses(modulus, "add `post: {}`");
}

}  // namespace
}  // namespace tunica::test
