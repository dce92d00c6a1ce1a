// `tunica fibres`: exit codes, and from a tube over its directions to a run with fibres.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace tunica::test {
namespace {

class FibresCommand : public Program {
 protected:
  static constexpr const char* tube =
      "meshes:\n"
      "  tube: {radius: 5 mm, length: 20 mm, wall_thickness: 1 mm, cells_around: 16, cells_along: 6}\n"
      "  interface: {lumen: lumen_wall, wall: wall_inner}\n";
};

TEST_F(FibresCommand, TwoForWrongInputWhichIsReportedAtOnce) {
  write("fibres.yaml", std::string(tube) + "inlet: wall_inlet\nouter: wall_outer\nmean_angle: 35\nnormal: smooth\n");
  EXPECT_EQ(tunica("fibres fibres.yaml"), 2);
  for (const char* text : {"mean_angle", "`35` has no unit", "smooth"})
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\n" << printed();
  write("fibres.yaml", std::string(tube) +
                           "inlet: wall_inlt\nouter: wall_outr\nmean_angle: 35 deg\n"
                           "regions: {flap: {mean_angle: 20 deg}}\n");
  EXPECT_EQ(tunica("fibres fibres.yaml"), 2);
  for (const char* text : {"no face 'wall_inlt'", "no face 'wall_outr'", "regions.flap", "wall_inlet"})
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\n" << printed();
  write("fibres.yaml",
        "meshes:\n  tube: {radius: 5 mm, length: 20 mm, wall_thickness: 1 mm}\n"
        "inlet: wall_inlet\nmean_angle: 35 deg\n");
  EXPECT_EQ(tunica("fibres fibres.yaml"), 2);
  for (const char* text : {"is missing, and `meshes.interface` too", "is lumen_and_wall, but there is no lumen"})
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\n" << printed();
  EXPECT_FALSE(fs::exists(folder_ / "fibres"));
}

TEST_F(FibresCommand, WhatItWritesIsTheFibreFrameOfARun) {
  write("fibres.yaml", std::string(tube) +
                           "inlet: [wall_inlet, lumen_inlet]\nouter: wall_outer\nmean_angle: 35 deg\n"
                           "output: .\n");
  ASSERT_EQ(tunica("fibres fibres.yaml"), 0) << printed();
  EXPECT_NE(printed().find("outlets: lumen_outlet, wall_outlet"), std::string::npos) << printed();
  EXPECT_EQ(tunica("fibres fibres.yaml"), 2) << "a result is there";
  EXPECT_EQ(tunica("fibres fibres.yaml --overwrite"), 0) << printed();
  const auto report = nlohmann::json::parse(read("report.json"));
  EXPECT_EQ(report["wall"]["jump_above_30_deg_percent"], 0);
  EXPECT_GT(report["wall"]["mean_confidence"], 0.8);

  // The sections that meshes.yaml gives, in a case.
  const std::string frame = "fibre_frame: {mesh: {e1: e1, e2: e2}}";
  ASSERT_NE(read("meshes.yaml").find(frame), std::string::npos) << read("meshes.yaml");
  write("case.yaml",
        "analysis: fsi\nelements: linear\n" + read("meshes.yaml") +
            "fluid: {}\n"
            "wall:\n  density: 1100 kg/m^3\n  " +
            frame +
            "\n  material: {hgo: {shear_modulus: 40 kPa, poisson_ratio: 0.5, families: [{k1: 60 kPa, k2: 5, "
            "mean_angle: 35 deg}]}}\n"
            "boundary: {lumen_inlet: {pressure: 1 kPa}, lumen_outlet: {pressure: 0 Pa}, wall_inlet: fixed, "
            "wall_outlet: fixed, wall_outer: free}\n"
            "time: {step: 0.1 ms, steps: 1}\n");
  ASSERT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_EQ(tunica("run case.yaml"), 0) << printed();
}

}  // namespace
}  // namespace tunica::test
