#include "tunica/case/study_case.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "tunica/base/error.hpp"

namespace tunica::case_file {
namespace {

namespace fs = std::filesystem;

class StudyFile : public ::testing::Test {
 protected:
  StudyFile() : folder_(fs::temp_directory_path() / ("tunica_study_case_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "case.yaml") << "analysis: flow\n";
  }
  ~StudyFile() override { fs::remove_all(folder_); }

  StudyPoints points(const std::string& text) const {
    std::ofstream(folder_ / "study.yaml") << "case: case.yaml\n" << text;
    return study_points(read_study_case(folder_ / "study.yaml").value);
  }
  std::string message(const std::string& text) const {
    try {
      points(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  /// Values of the points, one line for each.
  std::string lines(const std::string& text) const {
    std::string all;
    for (const auto& point : points(text).points) {
      for (const auto& value : point.values) all += value + ";";
      all += "\n";
    }
    return all;
  }

  fs::path folder_;
};

TEST_F(StudyFile, GridTakesAllCombinationsAndKeepsUnits) {
  EXPECT_EQ(lines("vary: {time.step: [1 ms, 2 ms], wall/regions/flap/density: {from: 1000 kg/m^3, to: 1.2e3 kg/m^3, "
                  "count: 3}}\n"),
            "1 ms;1000 kg/m^3;\n1 ms;1100 kg/m^3;\n1 ms;1200 kg/m^3;\n"
            "2 ms;1000 kg/m^3;\n2 ms;1100 kg/m^3;\n2 ms;1200 kg/m^3;\n");
  const auto read = points("vary: {wall/density: [1 g/cm^3, 2 g/cm^3]}\n");
  EXPECT_EQ(read.axes[0].label(), "wall.density [g/cm^3]");
  EXPECT_EQ(read.points[1].numbers[0], 2);
  EXPECT_EQ(read.points[1].text(read.axes), "wall.density = 2 g/cm^3");
}

TEST_F(StudyFile, ListGoesThroughAllKeysAtOnce) {
  EXPECT_EQ(lines("vary: {a: [1, 2, 3], b: [x, y, x]}\ndesign: list\n"), "1;x;\n2;y;\n3;x;\n");
  const auto read = points("vary: {a: [1, 2, 3], b: [x, y, x]}\ndesign: list\n");
  EXPECT_TRUE(read.axes[0].numeric);
  EXPECT_FALSE(read.axes[1].numeric);
  EXPECT_EQ(read.points[2].numbers[1], 1);  // the name of the first point
}

TEST_F(StudyFile, LogarithmicRangesHaveEqualRatios) {
  EXPECT_EQ(lines("vary: {a: {from: 1 Pa, to: 100 Pa, count: 3, scale: log}}\n"), "1 Pa;\n10 Pa;\n100 Pa;\n");
}

TEST_F(StudyFile, SampledPointsLieBetweenTheEndsAndDependOnTheSeedAlone) {
  for (const std::string design : {"latin_hypercube", "sobol"}) {
    const std::string text = "vary: {a: {between: [1 mm, 3 mm]}, b: {between: [1, 100], scale: log}}\ndesign: {" +
                             design + ": {points: 16, seed: ";
    const auto read = points(text + "7}}\n");
    ASSERT_EQ(read.points.size(), 16U);
    int low = 0;
    for (const auto& point : read.points) {
      EXPECT_TRUE(point.numbers[0] >= 1 && point.numbers[0] <= 3);
      EXPECT_TRUE(point.values[0].ends_with(" mm"));
      low += point.numbers[1] < 10;
    }
    EXPECT_EQ(low, 8) << design;  // half of them below the geometric mean
    EXPECT_EQ(lines(text + "7}}\n"), lines(text + "7}}\n"));
    EXPECT_NE(lines(text + "7}}\n"), lines(text + "8}}\n"));
  }
  EXPECT_EQ(
      points("vary: {a: {between: [1, 3]}, b: {between: [1, 3]}}\ndesign: {saltelli: {points: 4}}\n").points.size(),
      16U);
}

TEST_F(StudyFile, SaysWhatIsWrong) {
  const auto has = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << text << "\n" << message(text);
  };
  has("vary: {}\n", "names no key");
  has("vary: {a: {from: 1 mm, to: 2 cm, count: 3}}\n", "have different units");
  has("vary: {a: {from: 3 mm, to: 2 mm, count: 3}}\n", "is not below");
  has("vary: {a: {from: 1 mm, to: 2 mm}}\n", "lacks one of from, to and count");
  has("vary: {a: {from: 0 mm, to: 2 mm, count: 3, scale: log}}\n", "has no logarithm");
  has("vary: {a: {from: one, to: 2 mm, count: 3}}\n", "`one` is no number");
  has("vary: {a: {between: [1, 2]}}\n", "the design does not sample");
  has("vary: {a: [1, 2]}\ndesign: {sobol: {points: 8}}\n", "has no `between`");
  has("vary: {a: [1, 2], b: [1, 2, 3]}\ndesign: list\n", "b: has 3 values, and a has 2");
  has("vary: {a: [1 mm, 2 mm, 1.0 mm]}\n", "point 3: is point 1 again");
  has("vary: {a.b: [1], a/b: [2]}\n", "stands twice");
  has("vary: {a: {from: 0, to: 1, count: 1000}, b: {from: 0, to: 1, count: 1000}}\n", "has 1000000 points");
  has("vary: {a: [1, 2]}\ndesign: {sobol: {}}\n", "`points` is missing");
  has("vary: {a: [1, 2]}\ndesigns: grid\n", "did you mean `design`?");
}

}  // namespace
}  // namespace tunica::case_file
