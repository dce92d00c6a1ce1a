// `tunica what-if` on a short tube: loads that change, and what is refused before any work.
#include <nlohmann/json.hpp>
#include <regex>

#include "program.hpp"

namespace tunica::test {
namespace {

class WhatIfCommand : public Program {
 protected:
  void write_case(const std::string& more = "post: {}\n") const {
    write("flow.csv", "time,flow\n0,20\n4,30\n8,10\n12,20\n");
    write("case.yaml",
          "title: Tube\nanalysis: flow\n"
          "meshes: {tube: {radius: 5 mm, length: 20 mm, cells_around: 8, cells_radial: 1, cells_along: 4}}\n"
          "fluid: {}\n"
          "boundary: {lumen_inlet: {flow: {table: {file: flow.csv, time_unit: ms, unit: ml/s}}}, lumen_outlet: "
          "{resistance: 5e7 Pa s/m^3}, lumen_wall: no_slip}\n"
          "time: {step: 2 ms, steps: 6, rho_infinity: 0.2}\noutput: {directory: results}\n" +
              more);
  }
  void write_variants(const std::string& text) const { write("what_if.yaml", "case: case.yaml\nvariants:\n" + text); }
};

TEST_F(WhatIfCommand, ChangesTheBeatAndTellsAllSideBySide) {
  write_case();
  write_variants(
      "  fast: {heart_rate: 2}\n  strong: {stroke_volume: 1.5}\n"
      "  narrow: {set: 'boundary.lumen_outlet={resistance: 1e8 Pa s/m^3}'}\n");
  ASSERT_EQ(tunica("what-if what_if.yaml"), 0) << printed();
  const auto mean = [&](const std::string& post, const char* what) {
    const auto page = nlohmann::json::parse(read(post));
    for (const auto& opening : page["openings"])
      if (opening["name"] == "lumen_outlet")
        return std::string(what) == "flow" ? opening["flow_outwards"]["mean_ml_s"].get<double>()
                                           : opening["pressure"]["mean_mmHg"].get<double>();
    return 0.0;
  };
  const std::string base = "results/post/post.json";
  // Twice the beats of the same volume, half the time for each; half as much more volume.
  EXPECT_NEAR(mean("what_if/fast/post/post.json", "flow") / mean(base, "flow"), 2, 0.02);
  EXPECT_NEAR(mean("what_if/strong/post/post.json", "flow") / mean(base, "flow"), 1.5, 0.01);
  EXPECT_NEAR(mean("what_if/narrow/post/post.json", "pressure") / mean(base, "pressure"), 2, 0.05);
  const auto fast = read("what_if/fast/case.yaml");
  EXPECT_NE(fast.find("time_unit: 0.5 ms"), std::string::npos) << fast;
  EXPECT_NE(fast.find("step: 1 ms"), std::string::npos) << fast;
  EXPECT_NE(read("what_if/what_if.html").find("as it is"), std::string::npos);
  EXPECT_NE(read("what_if/what_if.csv").find("openings/lumen_outlet/pressure/mean_mmHg,mmHg,"), std::string::npos);
  // Again: all is there.
  ASSERT_EQ(tunica("what-if what_if.yaml"), 0) << printed();
  EXPECT_EQ(printed().find("steps are computed"), std::string::npos);
}

TEST_F(WhatIfCommand, RefusesBeforeAnyWork) {
  write_case();
  write_variants(
      "  nothing: {}\n  harder: {pressure: 1.2}\n  finer: {set: 'meshes.tube.cells_along=8'}\n"
      "  typed: {set: ['fluid.densty=1 kg/m^3']}\n");
  EXPECT_EQ(tunica("what-if what_if.yaml"), 2);
  EXPECT_NE(printed().find("variants.nothing"), std::string::npos) << printed();
  write_variants(
      "  harder: {pressure: 1.2}\n  finer: {set: 'meshes.tube.cells_along=8'}\n"
      "  typed: {set: ['fluid.densty=1 kg/m^3']}\n");
  EXPECT_EQ(tunica("what-if what_if.yaml"), 2);
  for (const char* message : {"variants.harder: outlets", "variants.finer: set", "tunica study", "densty"})
    EXPECT_NE(printed().find(message), std::string::npos) << message << "\n" << printed();
  EXPECT_FALSE(fs::exists(folder_ / "results/manifest.json"));
  write_case("");
  write_variants("  strong: {stroke_volume: 1.5}\n");
  EXPECT_EQ(tunica("what-if what_if.yaml"), 2);
  EXPECT_NE(printed().find("add `post: {}`"), std::string::npos) << printed();
}

TEST_F(WhatIfCommand, TellsThatThereIsNoSuchTear) {
  write_case();
  write("case.yaml", std::regex_replace(read("case.yaml"), std::regex("length: 20 mm"), "length: 80 mm"));
  write_variants("  closed: {close_tears: tear_3}\n");
  EXPECT_EQ(tunica("what-if what_if.yaml"), 2);
  EXPECT_NE(printed().find("variants.closed: close_tears"), std::string::npos) << printed();
}

}  // namespace
}  // namespace tunica::test
