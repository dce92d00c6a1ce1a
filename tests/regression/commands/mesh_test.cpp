// `tunica mesh`: exit codes, and the example of a dissection from its geometry to a first step of blood and wall.
#include "folders.hpp"
#include "program.hpp"

namespace tunica::test {
namespace {

class MeshCommand : public Program {};

TEST_F(MeshCommand, TwoForWrongInputWhichIsReportedAtOnce) {
  write("mesh.yaml",
        "geometry: {parametric: {aorta: {ascending_radius: 16}, flap: {turns: 7}, coeliac: {}}}\nsize: huge\n");
  EXPECT_EQ(tunica("mesh mesh.yaml"), 2);
  for (const char* text : {"ascending_radius", "turns", "coeliac", "huge"})
    EXPECT_NE(printed().find(text), std::string::npos) << text << "\n" << printed();
  write("mesh.yaml", "geometry: {parametric: {flap: {entry_tear: {area: 900 mm^2}}}}\n");
  EXPECT_EQ(tunica("mesh mesh.yaml"), 2);
  EXPECT_NE(printed().find("the flap there has a width"), std::string::npos) << printed();
  EXPECT_EQ(tunica("mesh nowhere.yaml"), 2);
  EXPECT_FALSE(fs::exists(folder_ / "mesh"));
}

TEST_F(MeshCommand, ImagesAreWrittenAndWhatTheyLackIsSaid) {
  write("scan.yaml", "scan: {voxel: 2 mm, noise: 0}\noutput: images/scan.nii.gz\n");
  ASSERT_EQ(tunica("image scan.yaml"), 0) << printed();
  // The section that it prints is one of a mesh file.
  const std::string section = printed().substr(printed().find("geometry:"));
  EXPECT_TRUE(fs::exists(folder_ / "images/scan.nii.gz"));
  EXPECT_EQ(tunica("image scan.yaml"), 2) << "an image is there";

  const auto refused = [&](const std::string& text) {
    write("images/mesh.yaml", text);
    EXPECT_EQ(tunica("mesh images/mesh.yaml"), 2);
    return printed();
  };
  auto labels = section;
  labels.replace(labels.find("false_lumen: 2"), 14, "false_lumen: 5");
  EXPECT_NE(refused(labels).find("no voxel has the label 5; the image has 0, 1, 2"), std::string::npos) << printed();
  EXPECT_NE(refused(section + "    inlet: aorta\n").find("no opening is called 'aorta'"), std::string::npos)
      << printed();
  const std::string opening = "    openings: {inlet: {centre: [0 m, 0 m, 1 m]}}\n";
  EXPECT_NE(
      refused(section.substr(0, section.find("    openings")) + opening).find("no vessel ends within two radii of"),
      std::string::npos)
      << printed();
  write("images/mesh.yaml", "geometry: {image: {file: none.nrrd, smoothing: 9}}\n");
  EXPECT_EQ(tunica("mesh images/mesh.yaml"), 2);
  for (const char* text : {"none.nrrd", "smoothing"}) EXPECT_NE(printed().find(text), std::string::npos) << printed();
}

TEST_F(MeshCommand, TheExampleFromGeometryToAFirstStep) {
  const fs::path example = fs::path(TUNICA_SOURCE_DIR) / "examples/dissection";
  std::string text = slurp(example / "case.yaml");
  for (const std::string there = "../../out/dissection"; text.find(there) != std::string::npos;)
    text.replace(text.find(there), there.size(), "out");
  write("case.yaml", text);
  fs::copy_file(example / "inflow.csv", folder_ / "inflow.csv");
  ASSERT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_NE(printed().find("1/7 mesh       would be done: never done"), std::string::npos) << printed();
  // It is coarse, and says so.
  const auto warning = printed().find("warning");
  ASSERT_NE(warning, std::string::npos) << printed();
  EXPECT_EQ(printed().find("mesh.size: 2.5 elements across the lumen are asked for", warning), warning + 9)
      << printed();
  EXPECT_EQ(printed().find("warning", warning + 1), std::string::npos) << printed();
  ASSERT_EQ(tunica("run case.yaml --until fibres"), 0) << printed();
  EXPECT_NE(printed().find("genus 1, manifold"), std::string::npos) << printed();
  EXPECT_NE(printed().find("size: 2.5 elements across the lumen: `coarse` is for trying things"), std::string::npos)
      << printed();
  EXPECT_NE(printed().find("inlet: lumen_inlet, wall_inlet"), std::string::npos) << printed();
  EXPECT_EQ(tunica("mesh out/mesh/mesh.yaml"), 2) << "a mesh is there";

  // The case file of the mesh stage says the same as that of `tunica mesh`, and its result serves any case.
  write("out/mesh/step.yaml",
        "analysis: fsi\nelements: linear\n" + read("out/mesh/meshes.yaml") +
            "fluid: {}\nwall: {density: 1120 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: "
            "0.49}}}\n"
            "boundary:\n  lumen_inlet: {flow: {value: 100 ml/s, ramp_time: 50 ms}}\n"
            "  \"lumen_*\": {resistance: 1e9 Pa s/m^3}\n  \"wall_*\": fixed\n  wall_outer: free\n"
            "time: {step: 1 ms, steps: 2}\noutput: {directory: step}\n");
  ASSERT_EQ(tunica("run out/mesh/step.yaml --until 1 --verbose"), 0) << printed();
  EXPECT_NE(printed().find("step 1/2"), std::string::npos) << printed();
}

}  // namespace
}  // namespace tunica::test
