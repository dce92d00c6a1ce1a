#include "tunica/case/variant.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/case/case.hpp"

namespace tunica::case_file {
namespace {

namespace fs = std::filesystem;

class Variant : public ::testing::Test {
 protected:
  Variant() : folder_(fs::temp_directory_path() / ("tunica_variant_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "cases");
    std::ofstream(folder_ / "cases" / "case.yaml")
        << "title: Pulse\n"
           "analysis: flow\n"
           "meshes: {length_unit: mm, lumen: {simvascular: ../mesh}}\n"
           "fluid: {viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
           "boundary: {lumen_inlet: {pressure: 100 Pa}, lumen_outlet: {pressure: 0 Pa}, lumen_wall: no_slip}\n"
           "time: {step: 1 ms, steps: 10}\n"
           "output: {directory: out}\n";
  }
  ~Variant() override { fs::remove_all(folder_); }

  std::string vary(std::vector<std::string> settings, std::vector<std::string> removed = {}) const {
    return variant({.case_file = folder_ / "cases" / "case.yaml",
                    .output = folder_ / "study" / "fast.yaml",
                    .settings = std::move(settings),
                    .removed = std::move(removed)});
  }
  Case varied(std::vector<std::string> settings, std::vector<std::string> removed = {}) const {
    return parse_case(vary(std::move(settings), std::move(removed)), folder_ / "study" / "fast.yaml");
  }
  std::string message(std::vector<std::string> settings, std::vector<std::string> removed = {}) const {
    try {
      vary(std::move(settings), std::move(removed));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(Variant, HasTheNewValuesAndTheOldOnes) {
  const Case c = varied({"time.step=0.5 ms", "newton.max_iterations=7"});
  EXPECT_EQ(c.title, "Pulse");
  EXPECT_NEAR(c.time->step, 0.5e-3, 1e-15);
  EXPECT_EQ(c.newton.max_iterations, 7);
}

TEST_F(Variant, TakesWholeSectionsAndLosesKeys) {
  const Case c = varied({"time={step: 2 ms, cycles: {period: 1 s}}"}, {"title"});
  EXPECT_EQ(c.title, "");
  ASSERT_TRUE(c.time->cycles);
  EXPECT_NEAR(c.time->cycles->period, 1.0, 1e-12);
}

TEST_F(Variant, RewritesPathsAndHasAFolderOfResultsOfItsOwn) {
  const std::string text = vary({});
  EXPECT_NE(text.find("../mesh"), std::string::npos) << text;
  EXPECT_NE(text.find("directory: fast"), std::string::npos) << text;
  const std::string chosen = vary({"output.directory=there"});
  EXPECT_NE(chosen.find("directory: there"), std::string::npos) << chosen;
}

TEST_F(Variant, IsMadeInTheFolderOfTheCaseByBareNames) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "cases");
  write_variant({.case_file = "case.yaml", .output = "fast.yaml"});
  fs::current_path(before);
  std::ifstream file(folder_ / "cases" / "fast.yaml");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find("simvascular: ../mesh"), std::string::npos) << text;
}

TEST_F(Variant, RefusesValuesThatContainThemselves) {
  for (const char* setting : {"title=&a [*a]", "boundary=&b {lumen_inlet: *b}", "time=&t {<<: *t}"})
    EXPECT_NE(message({setting}).find("would contain itself"), std::string::npos) << message({setting});
}

TEST_F(Variant, SaysWhatIsWrong) {
  EXPECT_NE(message({"title.x=1"}).find("`x` can be no key of a value"), std::string::npos) << message({"title.x=1"});
  EXPECT_NE(message({"time.step"}).find("is no setting"), std::string::npos);
  EXPECT_NE(message({"time.stop=1 ms"}).find("time.stop"), std::string::npos);
  EXPECT_NE(message({}, {"solver"}).find("is no key"), std::string::npos);
  EXPECT_NE(message({"time={step: 1"}).find("the value of time"), std::string::npos);
}

}  // namespace
}  // namespace tunica::case_file
