// tunica material, verify and schema as programs: exit codes and what they leave behind.
#include "program.hpp"

namespace tunica::test {
namespace {

TEST_F(Program, MaterialTestsADeformedLaw) {
  const std::string law = "material: {mooney_rivlin: {c1: 20 kPa, c2: 5 kPa, poisson_ratio: 0.5}}\n";
  std::ofstream(folder_ / "sound.yaml") << law << "tests: {pull: {uniaxial: {to: 1.2}}}\n";
  EXPECT_EQ(tunica("material sound.yaml --output here"), 0) << printed();
  EXPECT_NE(read("here/pull.csv").find("sigma11 [kPa]"), std::string::npos);
  EXPECT_NE(read("here/pull.svg").find("<svg"), std::string::npos);
  std::ofstream(folder_ / "image.yaml") << law << "tests: {pull: {uniaxial: {to: 1.2}}}\noutput: {plots: png}\n";
  EXPECT_EQ(tunica("material image.yaml --output images"), 0) << printed();
  EXPECT_EQ(read("images/pull.png").substr(1, 3), "PNG");
  EXPECT_EQ(read("images/pull.svg"), "");
  std::ofstream(folder_ / "wrong.yaml") << law << "tests: {pull: {uniaxial: {to: 1.2 kPa}}}\n";
  EXPECT_EQ(tunica("material wrong.yaml"), 2) << printed();
  EXPECT_EQ(tunica("material"), 2);
  std::ofstream(folder_ / "failing.yaml") << "material: {hgo: {shear_modulus: 20 kPa, poisson_ratio: 0.5, families: "
                                             "[{k1: 1 kPa, k2: 99, mean_angle: 0 deg}]}}\n"
                                             "tests: {pull: {uniaxial: {to: 9}}}\n";
  EXPECT_EQ(tunica("material failing.yaml"), 3) << printed();
}

TEST_F(Program, VerifyPassesAndWritesTablesAndFigures) {
  EXPECT_EQ(tunica("verify"), 0) << printed();
  const std::string text = printed();
  EXPECT_NE(text.find("PASS: 36 of 36 comparisons passed"), std::string::npos) << text;
  EXPECT_EQ(text.find("FAIL"), std::string::npos) << text;
  for (const char* name : {"uniaxial.csv", "shear.csv", "comparisons.csv", "uniaxial.svg", "shear.svg"})
    EXPECT_GT(read(fmt::format("verification/{}", name)).size(), 1000u) << name;
  // The last point of figure 4(a), without exclusion: 154.797 kPa analytic, 154.010 by 256 directions.
  const std::string table = read("verification/shear.csv");
  EXPECT_NE(table.find("40,0.5,82.64435"), std::string::npos) << table;
  EXPECT_NE(table.find("154.7974"), std::string::npos);
}

TEST_F(Program, SchemaOfTheMaterialFile) {
  EXPECT_EQ(tunica("schema --material"), 0);
  EXPECT_NE(printed().find("simple_shear"), std::string::npos);
  EXPECT_EQ(tunica("schema --material --json"), 0);
  EXPECT_NE(printed().find("\"simple_shear\""), std::string::npos);
  EXPECT_EQ(tunica("schema"), 0);
  EXPECT_EQ(printed().find("simple_shear"), std::string::npos);
}

}  // namespace
}  // namespace tunica::test
