#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/case/measured_settings.hpp"

namespace tunica::case_file {
namespace {

class Measured : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tunica_measured_" + std::to_string(::getpid()) +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  MeasuredCase read(const std::string& entries) const {
    return config::parse_text(MeasuredCase::schema(), "{" + entries + "}", {.name = "case.yaml", .folder = folder_})
        .value;
  }
  std::string message(const std::string& entries) const {
    try {
      read(entries);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_;
};

TEST_F(Measured, ValuesAreSi) {
  const auto m =
      read("pressures: {cuff: {opening: inlet, systolic: 120 mmHg, diastolic: 70 mmHg, uncertainty: 5 mmHg}}");
  ASSERT_EQ(m.pressures.size(), 1U);
  EXPECT_NEAR(*m.pressures[0].second.largest, 120 * 133.322387415, 1e-6);
  EXPECT_NEAR(*m.pressures[0].second.uncertainty, 5 * 133.322387415, 1e-6);
}

TEST_F(Measured, WhatIsWrongIsTold) {
  const auto contains = [&](const std::string& entries, const std::string& text) {
    const auto told = message(entries);
    EXPECT_NE(told.find(text), std::string::npos) << entries << ": " << told;
  };
  contains("pressures: {a: {opening: i, systolic: 120 mmHg}}", "uncertainty");
  contains("pressures: {a: {systolic: 120 mmHg, uncertainty: 5 mmHg}}", "names no place");
  contains("pressures: {a: {opening: i, uncertainty: 5 mmHg}}", "has no value");
  contains("pressures: {a: {opening: i, systolic: 120 ml/s, uncertainty: 5 mmHg}}", "systolic");
  contains("pressures: {a: {opening: i, systolic: 60 mmHg, diastolic: 70 mmHg, uncertainty: 5 mmHg}}", "lies below");
  contains("flows: {a: {point: p, mean: 80 ml/s, uncertainty: 5 ml/s}}", "point");
  contains("areas: {a: {plane: {centre: [0 mm, 0 mm, 0 mm], normal: [0, 0, 0]}, mean: 3 mm^2, uncertainty: 1 mm^2}}",
           "has no length");
  contains(
      "pressures: {a: {opening: i, mean: 90 mmHg, uncertainty: 5 mmHg}}, "
      "flows: {a: {opening: i, mean: 90 ml/s, uncertainty: 5 ml/s}}",
      "name of another measurement");
}

TEST_F(Measured, CurvesReadAndPointsAreLookedFor) {
  std::ofstream(folder_ / "flows.csv") << "time [s],aorta [ml/s],aorta deviation [ml/s]\n0,10,1\n0.1,20,2\n0.3,5,1\n";
  const std::string curve = "file: flows.csv, time_unit: s, unit: ml/s, value_column: \"aorta [ml/s]\"";
  const auto m = read("flows: {a: {opening: i, curve: {" + curve +
                      ", shift: 50 ms, uncertainty_column: \"aorta deviation [ml/s]\"}}}");
  const auto course = read_course(m.flows[0].second);
  ASSERT_EQ(course.times.size(), 3U);
  EXPECT_NEAR(course.times[1], 0.15, 1e-12);
  EXPECT_NEAR(course.values[1], 20e-6, 1e-15);
  EXPECT_NEAR(course.deviations[1], 2e-6, 1e-15);
  EXPECT_TRUE(check_measured(m, {}).empty());
  const auto wrong = read(
      "flows: {a: {opening: i, uncertainty: 1 ml/s, curve: {file: flows.csv, time_unit: s, unit: "
      "ml/s, value_column: flow}}}, "
      "displacements: {b: {point: flap, largest: 1 mm, uncertainty: 0.1 mm}}");
  const auto problems = check_measured(wrong, {"root"});
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_NE(problems[0].where.find("measured.flows.a.curve"), std::string::npos);
  EXPECT_EQ(problems[1].where, "measured.displacements.b.point");
}

}  // namespace
}  // namespace tunica::case_file
