// `tunica mesh`: exit codes, and the example of a dissection from its geometry to a first step of blood and wall.
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
      refused(section.substr(0, section.find("    openings")) + opening).find("no vessel ends in a flat face within"),
      std::string::npos)
      << printed();
  write("images/mesh.yaml", "geometry: {image: {file: none.nrrd, smoothing: 9}}\n");
  EXPECT_EQ(tunica("mesh images/mesh.yaml"), 2);
  for (const char* text : {"none.nrrd", "smoothing"}) EXPECT_NE(printed().find(text), std::string::npos) << printed();
}

TEST_F(MeshCommand, TheExampleFromGeometryToAFirstStep) {
  const fs::path example = fs::path(TUNICA_SOURCE_DIR) / "examples/dissection";
  ASSERT_EQ(tunica(fmt::format("mesh {} -o mesh", (example / "mesh.yaml").string())), 0) << printed();
  EXPECT_NE(printed().find("genus 1, manifold"), std::string::npos) << printed();
  EXPECT_EQ(tunica(fmt::format("mesh {} -o mesh", (example / "mesh.yaml").string())), 2) << "a mesh is there";

  std::string text = slurp(example / "case.yaml");
  for (const std::string there = "../../out/dissection/"; text.find(there) != std::string::npos;)
    text.erase(text.find(there), there.size());
  write("case.yaml", text);
  ASSERT_EQ(tunica("check case.yaml"), 0) << printed();
  EXPECT_NE(printed().find("no errors, 0 warnings"), std::string::npos) << printed();
  ASSERT_EQ(tunica("run case.yaml --until 1"), 0) << printed();
  EXPECT_NE(printed().find("step 1/"), std::string::npos) << printed();

  // What `tunica mesh` says about a case file is what the example has.
  const std::string section = slurp(folder_ / "mesh/meshes.yaml");
  const auto regions = section.substr(section.find("regions: {"),
                                      section.find('}', section.find("regions: {")) - section.find("regions: {"));
  EXPECT_NE(text.find(regions), std::string::npos) << section;
}

}  // namespace
}  // namespace tunica::test
