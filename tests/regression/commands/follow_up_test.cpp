// `tunica follow-up`: what it refuses before any work, and scans that were meshed before.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace tunica::test {
namespace {

class FollowUpCommand : public Program {
 protected:
  void write_case(const std::string& name = "case.yaml", const std::string& size = "coarse") const {
    write(name, fmt::format("analysis: flow\nmesh: {{geometry: {{parametric: {{}}}}, size: {}}}\nfluid: {{}}\n"
                            "boundary:\n  lumen_inlet: {{flow: 20 ml/s}}\n"
                            "  \"lumen_*\": {{resistance: 5e7 Pa s/m^3}}\n  lumen_wall: no_slip\n"
                            "time: {{step: 4 ms, steps: 3}}\npost: {{}}\noutput: {{directory: results}}\n",
                            size));
  }
  void write_scans(const std::string& text) const { write("scans.yaml", "case: case.yaml\nscans:\n" + text); }
  /// Fails with exit code 2 and all of these.
  void expect_refusal(const std::string& arguments, std::initializer_list<const char*> messages) const {
    EXPECT_EQ(tunica("follow-up scans.yaml " + arguments), 2) << printed();
    for (const char* message : messages)
      EXPECT_NE(printed().find(message), std::string::npos) << message << "\n" << printed();
    EXPECT_FALSE(fs::exists(folder_ / "follow_up/a/mesh/report.json"));
  }
};

TEST_F(FollowUpCommand, RefusesDatesThatAreSwappedOrNone) {
  write_case();
  write_scans(
      "  a: {date: 2021-03-04, geometry: {parametric: {}}}\n"
      "  b: {date: 2020-03-04, geometry: {parametric: {}}}\n");
  expect_refusal("", {"scans.b.date", "2020-03-04 is not after 2021-03-04", "swapped"});
  write_scans(
      "  a: {date: 2021-02-30, geometry: {parametric: {}}}\n"
      "  b: {date: 2022-03-04}\n");
  expect_refusal("", {"`2021-02-30` is no day", "has neither `case` nor `geometry`"});
  write_scans("  a: {date: 2021-02-03, geometry: {parametric: {}}}\n");
  expect_refusal("", {"fewer than two"});
}

TEST_F(FollowUpCommand, RefusesOtherBranchesAndOtherMeshSettings) {
  write_case();
  write_case("fine.yaml", "fine");
  write_scans(
      "  a: {date: 2021-03-04, geometry: {parametric: {}}}\n"
      "  b: {date: 2022-03-04, geometry: {parametric: {celiac: {}}}}\n"
      "  c: {date: 2023-03-04, case: fine.yaml}\n");
  expect_refusal("", {"scans.b: ", "has the opening celiac, which a has not", "scans.c: mesh.size",
                      "mesh all scans by the same settings"});
}

TEST_F(FollowUpCommand, RefusesRunsWithoutFiguresAndSaysWhatItWouldDo) {
  write_case();
  const std::string scans =
      "  a: {date: 2021-03-04, geometry: {parametric: {}}}\n"
      "  b: {date: 2022-03-04, geometry: {parametric: {aorta: {dissected_radius: 17 mm}}}}\n";
  write_scans(scans);
  ASSERT_EQ(tunica("follow-up scans.yaml --dry-run --run"), 0) << printed();
  EXPECT_NE(printed().find("b (2022-03-04)"), std::string::npos);
  EXPECT_NE(read("follow_up/b/case.yaml").find("17 mm"), std::string::npos);
  EXPECT_NE(read("follow_up/b/case.yaml").find("b, 2022-03-04"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "follow_up/b/mesh/report.json"));
  std::string text = read("case.yaml");
  text.erase(text.find("post: {}\n"), 9);
  write("case.yaml", text);
  expect_refusal("--run", {"scans.a: post", "add `post: {}`"});
}

}  // namespace
}  // namespace tunica::test
