// The page of `tunica report`; that of a whole case is in the regression tests of the commands.
#include "tunica/stages/report/report.hpp"

#include <gtest/gtest.h>

#include "shared_folder.hpp"

namespace tunica::stages {
namespace {

using test::SharedFolder;

constexpr const char* dissipation =
    R"({"limit": 0.5, "from_s": 0, "until_s": 1, "elements": "linear", "parts": [
        {"part": "true lumen", "viscous_J": 2, "numerical_J": 0.5, "ratio": 0.25, "above_limit": false},
        {"part": "tear_1", "viscous_J": 2, "numerical_J": 3, "ratio": 1.5, "above_limit": true}]})";

std::string page_of(const SharedFolder& folder, const std::string& post) {
  folder.write("post.json", post);
  ReportCase c;
  c.case_file = folder.write("case.yaml", "{}");
  c.stages["post"] = folder.path();
  c.settings.pictures = false;
  c.output = folder.path();
  return test::slurp(report_to_file(c, {"1", "abc"}, true, [](const std::string&) {}));
}

std::string post_json(const std::string& of_tear_1) {
  return std::string(R"({"numerical_dissipation": )") + dissipation + R"(, "tears": [
      {"name": "tear_1", "area_mm2": 12.25)" +
         of_tear_1 + R"(}, {"name": "tear_2", "area_mm2": 13.75}], "wall_shear": {"tawss_Pa": {"mean": 1.125})" +
         of_tear_1 + "}}";
}

TEST(Report, MarksFiguresWhereTheSchemeDisturbsTheFlow) {
  const SharedFolder folder(MPI_COMM_SELF);
  const std::string page = page_of(folder, post_json(R"(, "numerically_dissipated_in": ["tear_1"])"));
  for (const char* marked :
       {"<td>12.25 †</td>", "<td>1.125 †</td>", "<td>tear_1 †</td>", "1.5 times in: tear_1", "bear the mark †"})
    EXPECT_NE(page.find(marked), std::string::npos) << marked;
  EXPECT_NE(page.find("<td>13.75</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>true lumen</td>"), std::string::npos);

  const std::string unmarked = page_of(folder, post_json(""));
  EXPECT_NE(unmarked.find("<td>12.25</td>"), std::string::npos);
}

std::size_t place(const std::string& page, const std::string& text) {
  const auto at = page.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  return at;
}

TEST(Report, OpensOnWhatWasFoundBesideTargets) {
  const SharedFolder folder(MPI_COMM_SELF);
  folder.write("tuning.json", R"({"tolerance": 0.02, "status": "converged", "cycles": [],
      "targets": {"systolic_Pa": 16665, "diastolic_Pa": 9999}, "target_fractions": {"lumen_outlet": 0.5}})");
  folder.write("post.json", R"({"openings": [
      {"name": "lumen_inlet", "inlet": true, "pressure": {"systolic_mmHg": 131.0, "diastolic_mmHg": 75.5}},
      {"name": "lumen_outlet", "inlet": false, "share_of_outflow": 0.495}],
      "wall_shear": {"tawss_Pa": {"mean": 0.25}}, "left_out": [{"part": "flap", "why": "the wall has none"}]})");
  ReportCase c;
  c.case_file = folder.write("case.yaml", "{}");
  c.stages["post"] = c.stages["outlets"] = folder.path();
  c.settings.pictures = false;
  c.output = folder.path();
  const std::string page = test::slurp(report_to_file(c, {"1", "abc"}, true, [](const std::string&) {}));
  EXPECT_LT(place(page, "id=\"answer\""), place(page, "id=\"mesh\""));
  EXPECT_LT(place(page, "id=\"mesh\""), place(page, "id=\"run\""));
  place(page,
        "<td>131</td><td>mmHg</td><td><span class=\"aside\">target 125.0, 2 % of it allowed</span></td><td><span "
        "class=\"bad\">outside</span></td>");
  place(page,
        "<td>75.5</td><td>mmHg</td><td><span class=\"aside\">target 75.0, 2 % of it allowed</span></td><td><span "
        "class=\"good\">within</span></td>");
  place(page,
        "<td>49.5</td><td>%</td><td><span class=\"aside\">target 50, 2 % of it allowed</span></td><td><span "
        "class=\"good\">within</span></td>");
  place(page,
        "<td>0.25</td><td>Pa</td><td><span class=\"aside\">endothelium is quiescent above 1.5 and atherogenic below "
        "0.4 (Malek et al. 1999, "
        "JAMA 282:2035)</span></td>"
        "<td><span class=\"bad\">outside</span></td>");
  place(page, "Left out: flap");
  place(page, "default-src 'none'; script-src 'sha256-");
}

TEST(Report, ListsWhatTheRunWasSetTo) {
  const SharedFolder folder(MPI_COMM_SELF);
  folder.write("stage.json", R"({"status": "done", "seconds": 1.5, "ranks": 1, "time": "", "program": {},
      "inputs": {"settings": {"fluid.density": "1060"}, "files": {}}})");
  ReportCase c;
  c.case_file = folder.write("case.yaml", "{}");
  c.stages["run"] = folder.path();
  c.settings.pictures = false;
  c.output = folder.path();
  const std::string page = test::slurp(report_to_file(c, {"1", "abc"}, true, [](const std::string&) {}));
  place(page, "<td>fluid.density</td><td>1060</td>");
}

}  // namespace
}  // namespace tunica::stages
