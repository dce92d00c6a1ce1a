// tunica material, verify and schema as programs: exit codes and what they leave behind.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace tunica::test {
namespace {

namespace fs = std::filesystem;

class Program : public testing::Test {
 protected:
  Program() {
    folder_ = fs::temp_directory_path() /
              fmt::format("tunica_{}_{}", getpid(), testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  ~Program() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  int run(const std::string& arguments) const {
    const int status =
        std::system(fmt::format("cd {} && {} {} > out.txt 2>&1", folder_.string(), TUNICA_PROGRAM, arguments).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

TEST_F(Program, MaterialTestsADeformedLaw) {
  const std::string law = "material: {mooney_rivlin: {c1: 20 kPa, c2: 5 kPa, poisson_ratio: 0.5}}\n";
  std::ofstream(folder_ / "sound.yaml") << law << "tests: {pull: {uniaxial: {to: 1.2}}}\n";
  EXPECT_EQ(run("material sound.yaml --output here"), 0) << read("out.txt");
  EXPECT_NE(read("here/pull.csv").find("sigma11 [kPa]"), std::string::npos);
  EXPECT_NE(read("here/pull.svg").find("<svg"), std::string::npos);
  std::ofstream(folder_ / "wrong.yaml") << law << "tests: {pull: {uniaxial: {to: 1.2 kPa}}}\n";
  EXPECT_EQ(run("material wrong.yaml"), 2) << read("out.txt");
  EXPECT_EQ(run("material"), 2);
  std::ofstream(folder_ / "failing.yaml") << "material: {hgo: {shear_modulus: 20 kPa, poisson_ratio: 0.5, families: "
                                             "[{k1: 1 kPa, k2: 99, mean_angle: 0 deg}]}}\n"
                                             "tests: {pull: {uniaxial: {to: 9}}}\n";
  EXPECT_EQ(run("material failing.yaml"), 3) << read("out.txt");
}

TEST_F(Program, VerifyPassesAndWritesTablesAndFigures) {
  EXPECT_EQ(run("verify"), 0) << read("out.txt");
  const std::string printed = read("out.txt");
  EXPECT_NE(printed.find("PASS: 36 of 36 comparisons passed"), std::string::npos) << printed;
  EXPECT_EQ(printed.find("FAIL"), std::string::npos) << printed;
  for (const char* name : {"uniaxial.csv", "shear.csv", "comparisons.csv", "uniaxial.svg", "shear.svg"})
    EXPECT_GT(read(fmt::format("verification/{}", name)).size(), 1000u) << name;
  // The last point of figure 4(a), without exclusion: 154.797 kPa analytic, 154.010 by 256 directions.
  const std::string table = read("verification/shear.csv");
  EXPECT_NE(table.find("40,0.5,82.64435"), std::string::npos) << table;
  EXPECT_NE(table.find("154.7974"), std::string::npos);
}

TEST_F(Program, SchemaOfTheMaterialFile) {
  EXPECT_EQ(run("schema --material"), 0);
  EXPECT_NE(read("out.txt").find("simple_shear"), std::string::npos);
  EXPECT_EQ(run("schema --material --json"), 0);
  EXPECT_NE(read("out.txt").find("\"simple_shear\""), std::string::npos);
  EXPECT_EQ(run("schema"), 0);
  EXPECT_EQ(read("out.txt").find("simple_shear"), std::string::npos);
}

}  // namespace
}  // namespace tunica::test
