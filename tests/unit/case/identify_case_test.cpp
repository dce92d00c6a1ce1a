#include "tunica/case/identify_case.hpp"

#include <gtest/gtest.h>

#include "text.hpp"
#include "tunica/base/error.hpp"

namespace tunica::case_file {
namespace {

IdentifyCase read(const std::string& text) {
  return config::parse_text(IdentifyCase::schema(), "case: case.yaml\n" + text, {.check_files = false}).value;
}

std::string refusal_of(const std::string& text) {
  return test::message_of<InputError>([&] { read(text); });
}

TEST(IdentifyCase, DescriptionIsSound) {
  EXPECT_EQ(config::audit(*IdentifyCase::schema().description()), std::vector<std::string>{});
}

TEST(IdentifyCase, ReadsWithItsDefaults) {
  const auto c = read(
      "parameters:\n"
      "  support: {keys: boundary.wall_outer.support.stiffness, between: [1e6 N/m^3, 1e8 N/m^3]}\n"
      "  wall: {factor_on: [wall.density, wall.thickness], between: [0.3, 3], start: 0.8}\n"
      "measurements: areas/*\n");
  ASSERT_EQ(c.parameters.size(), 2U);
  EXPECT_EQ(c.parameters[0].second.keys, std::vector<std::string>{"boundary.wall_outer.support.stiffness"});
  EXPECT_EQ(c.parameters[0].second.start, "");
  EXPECT_EQ(c.parameters[1].second.factor_on.size(), 2U);
  EXPECT_EQ(c.parameters[1].second.start, "0.8");
  EXPECT_EQ(c.measurements, std::vector<std::string>{"areas/*"});
  EXPECT_EQ(c.max_runs, 30);
  EXPECT_EQ(c.output, "identify");
}

TEST(IdentifyCase, RefusesWhatHasNoMeaning) {
  const std::string bounds = "between: [1 Pa, 2 Pa]";
  EXPECT_NE(refusal_of("parameters: {}\n").find("names none"), std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a: {" + bounds + "}}\n").find("names no key"), std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a: {keys: b, factor_on: c, " + bounds + "}}\n").find("has both"),
            std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a: {keys: b, between: 1 Pa}}\n").find("has 1 entries"), std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a: {key: b, " + bounds + "}}\n").find("did you mean `keys`"), std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a/b: {keys: b, " + bounds + "}}\n").find("a/b"), std::string::npos);
  EXPECT_NE(refusal_of("parameters: {a: {keys: b, " + bounds + "}, c: {keys: d, " + bounds + "}}\nmax_runs: 3\n")
                .find("allow 4 or more"),
            std::string::npos);
}

}  // namespace
}  // namespace tunica::case_file
