#include "tunica/bc/conditions.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "text.hpp"
#include "tunica/config/schema.hpp"

namespace {

using tunica::test::contains;
using namespace tunica::bc;
using tunica::InputError;

struct Faces {
  std::vector<std::pair<std::string, Condition>> boundary;
  static tunica::config::Schema<Faces> schema() {
    return tunica::config::Schema<Faces>("faces", "For the test.")
        .map("boundary", &Faces::boundary, condition_schema(), "One condition per face");
  }
};

Condition read(const std::string& condition) {
  const auto faces =
      tunica::config::parse_text(Faces::schema(), "boundary: {face: " + condition + "}\n").value.boundary;
  EXPECT_EQ(faces.size(), 1u);
  return faces.at(0).second;
}

template <class C>
C as(const std::string& condition) {
  const auto read_condition = read(condition);
  EXPECT_TRUE(std::holds_alternative<C>(read_condition)) << condition;
  return std::get<C>(read_condition);
}

std::string refusal(const std::string& condition) {
  try {
    read(condition);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConditionSchema, DescriptionIsSound) {
  for (const auto& slip : tunica::config::audit(*condition_schema().description())) ADD_FAILURE() << slip;
}

TEST(ConditionSchema, BareNames) {
  as<NoSlip>("no_slip");
  as<Free>("free");
  EXPECT_EQ(as<Fixed>("fixed").axes(), (std::array<bool, 3>{true, true, true}));
}

TEST(ConditionSchema, FacesThatAreMoved) {
  const auto moved = as<Displacement>("{displacement: {value: [1 mm, 0 mm, 0 mm], directions: [x]}}");
  EXPECT_EQ(moved.value[0], 1e-3);
  EXPECT_EQ(moved.directions, (Axes{true, false, false}));
  EXPECT_EQ(as<Displacement>("{displacement: {value: [1 mm, 0 mm, 0 mm]}}").directions, (Axes{true, true, true}));
  EXPECT_TRUE(contains(refusal("{displacement: {value: [1 mm, 1 mm, 0 mm], directions: [x]}}"),
                       "moves the face along y, which `directions` leaves free"));
  EXPECT_TRUE(contains(refusal("{displacement: {value: [0 mm, 0 mm, 0 mm], directions: []}}"), "names no axis"));
}

TEST(ConditionSchema, LoadsOnFacesThatAreHeldAlongAxes) {
  EXPECT_EQ(as<Pressure>("{pressure: {value: 1 kPa, fixed: [x, y]}}").fixed, (Axes{true, true, false}));
  EXPECT_EQ(as<Pressure>("{pressure: 1 kPa}").fixed, Axes{});
  EXPECT_EQ(as<Traction>("{traction: {value: [0 Pa, 0 Pa, 1 Pa], fixed: [x]}}").fixed, (Axes{true, false, false}));
}

TEST(ConditionSchema, Fixed) {
  EXPECT_EQ(as<Fixed>("{fixed: {directions: [z]}}").axes(), (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(as<Fixed>("{fixed: [x, z]}").axes(), (std::array<bool, 3>{true, false, true}));
  EXPECT_TRUE(as<Fixed>("{fixed: {directions: [normal]}}").along_normal());
  EXPECT_TRUE(as<Fixed>("{fixed: [normal]}").along_normal());
  EXPECT_FALSE(as<Fixed>("{fixed: {directions: [all]}}").along_normal());
  EXPECT_TRUE(contains(refusal("{fixed: [normal, x]}"), "mixed"));
  EXPECT_TRUE(contains(refusal("{fixed: []}"), "direction"));
}

TEST(ConditionSchema, Outlets) {
  const auto rcr = as<Rcr>(
      "{rcr: {proximal: 121 dyn s/cm^5, capacitance: 1.5e-4 cm^5/dyn, distal: 1212 dyn s/cm^5, distal_pressure: 10 "
      "mmHg}}");
  EXPECT_NEAR(rcr.proximal, 1.21e7, 1e-5);
  EXPECT_NEAR(rcr.capacitance, 1.5e-9, 1e-20);
  EXPECT_NEAR(rcr.distal, 1.212e8, 1e-4);
  EXPECT_NEAR(rcr.distal_pressure, 1333.22, 0.01);
  EXPECT_FALSE(rcr.initial_pressure);
  EXPECT_EQ(as<Rcr>("{rcr: {proximal: 1e7 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e8 Pa s/m^3, "
                    "initial_pressure: 8 kPa}}")
                .initial_pressure.value(),
            8000.0);
  EXPECT_EQ(as<Resistance>("{resistance: {resistance: 1e8 Pa s/m^3}}").resistance, 1e8);
  EXPECT_EQ(as<Resistance>("{resistance: 1e8 Pa s/m^3}").resistance, 1e8);
  EXPECT_TRUE(contains(refusal("{rcr: {proximal: 1e7 Pa s/m^3}}"), "capacitance"));
  EXPECT_TRUE(contains(refusal("{rcr: {proximal: -1 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1 Pa}}"), "proximal"));
}

TEST(ConditionSchema, PressureVelocityTractionSupport) {
  const auto plain = as<Pressure>("{pressure: 80 mmHg}");
  EXPECT_TRUE(plain.follower);
  EXPECT_NEAR(make_waveform(plain.pressure).value(3.0), 10665.8, 0.1);
  const auto dead = as<Pressure>("{pressure: {step: {value: 1.3332e4 dyn/cm^2, end: 3 ms}, follower: false}}");
  EXPECT_FALSE(dead.follower);
  EXPECT_NEAR(make_waveform(dead.pressure).value(2e-3), 1333.2, 1e-9);
  EXPECT_EQ(make_waveform(dead.pressure).value(4e-3), 0.0);
  const auto ramped = as<Pressure>("{pressure: {value: 2 kPa, scale: 0.5, ramp_time: 10 ms}}");
  EXPECT_NEAR(make_waveform(ramped.pressure).value(5e-3), 500.0, 1e-9);
  const auto velocity = as<Velocity>("{velocity: {value: [0 m/s, 0 m/s, 50 cm/s]}}");
  EXPECT_EQ(velocity.value[2], 0.5);
  EXPECT_EQ(make_waveform(velocity.course).value(1.0), 1.0);
  const auto traction =
      as<Traction>("{traction: {value: [1 Pa, 0 Pa, 0 Pa], waveform: {step: {value: 3, start: 1 s}}}}");
  EXPECT_EQ(make_waveform(traction.course).value(2.0), 3.0);
  const auto support = as<Support>("{support: {stiffness: 1e7 N/m^3, damping: 1e4 N s/m^3, direction: normal}}");
  EXPECT_EQ(std::get<double>(support.stiffness), 1e7);
  EXPECT_EQ(std::get<double>(support.damping), 1e4);
  EXPECT_EQ(std::get<double>(support.pressure), 0.0);
  const auto varying = as<Support>("{support: {stiffness: {array: {name: ks, unit: N/cm^3}}, pressure: 2 kPa}}");
  EXPECT_EQ(std::get<FaceArray>(varying.stiffness).name, "ks");
  EXPECT_DOUBLE_EQ(std::get<FaceArray>(varying.stiffness).unit, 1e6);
  EXPECT_EQ(std::get<double>(varying.pressure), 2e3);
  ASSERT_EQ(varying.arrays().size(), 1u);
  EXPECT_EQ(varying.arrays()[0].name, "ks");
  EXPECT_FALSE(varying.arrays()[0].file);
  EXPECT_TRUE(varying.holds());
  EXPECT_TRUE(contains(refusal("{support: {stiffness: {array: {name: ks, unit: kPa}}}}"), "unit"));
  EXPECT_EQ(support.direction, Support::Direction::normal);
  EXPECT_TRUE(contains(refusal("{support: {stiffness: 1e7 N/m}}"), "stiffness"));
  EXPECT_TRUE(contains(refusal("{pressure: {follower: true}}"), "value"));
  EXPECT_TRUE(contains(refusal("{pressure: {value: 1 Pa, step: {value: 1 Pa}}}"), "step"));
  EXPECT_TRUE(contains(refusal("{pressure: {step: {value: 1 Pa, start: 2 s, end: 1 s}}}"), "ends before"));
}

TEST(ConditionSchema, FlowSignsAndTables) {
  EXPECT_NEAR(inflow(as<Flow>("{flow: 6 L/min}")).value(0.0), 1e-4, 1e-18);
  EXPECT_NEAR(inflow(as<Flow>("{flow: {value: 6 L/min, positive: outflow, profile: flat}}")).value(0.0), -1e-4, 1e-18);
  const auto path = std::filesystem::temp_directory_path() / "tunica_condition_schema_test.flow";
  std::ofstream(path) << "3 2\n0 0\n0.5 -8\n1 0\n";
  const auto table = as<Flow>("{flow: {table: {file: " + path.string() +
                              ", time_unit: 0.9 s, unit: cm^3/s, interpolation: fourier}}}");
  EXPECT_EQ(table.profile, Profile::parabolic);
  EXPECT_NEAR(inflow(table).mean(), 4e-6, 1e-18);
  EXPECT_NEAR(inflow(table).period().value(), 0.9, 1e-15);
  const auto raw =
      as<Flow>("{flow: {positive: inflow, table: {file: " + path.string() + ", time_unit: s, unit: cm^3/s}}}");
  EXPECT_NEAR(inflow(raw).value(0.5), (-4 - 32 / (M_PI * M_PI)) * 1e-6, 1e-12)
      << "two modes of the triangle, by default";
  const auto lines = as<Flow>("{flow: {positive: inflow, table: {file: " + path.string() +
                              ", time_unit: s, unit: cm^3/s, interpolation: linear}}}");
  EXPECT_NEAR(inflow(lines).value(0.5), -8e-6, 1e-18);
  EXPECT_TRUE(contains(refusal("{flow: {table: {file: " + path.string() + ", time_unit: s}}}"), "unit"));
  EXPECT_TRUE(contains(
      refusal("{flow: {table: {file: " + path.string() + ", time_unit: s, unit: ml/s, periodic: false, period: 1 s}}}"),
      "period"));
  std::filesystem::remove(path);
}

TEST(ConditionSchema, SlipsOfTheUnitAreWarnedOf) {
  const auto warnings = [](const std::string& condition) {
    return tunica::config::parse_text(Faces::schema(), "boundary: {face: " + condition + "}\n").warnings.size();
  };
  EXPECT_EQ(warnings("{resistance: 1212 Pa s/m^3}"), 1u);
  EXPECT_EQ(warnings("{resistance: 1212 dyn s/cm^5}"), 0u);
  EXPECT_EQ(warnings("{pressure: 80 bar}"), 1u);
  EXPECT_EQ(warnings("{flow: 83 L/s}"), 1u);
  EXPECT_EQ(warnings("{flow: -83 ml/s}"), 0u);
  EXPECT_EQ(warnings("{support: {stiffness: 10 N/m^3}}"), 1u);
}

TEST(ConditionSchema, UnknownConditionIsNamed) {
  EXPECT_TRUE(contains(refusal("{windkessel: {}}"), "windkessel"));
  EXPECT_TRUE(contains(refusal("rcr"), "proximal"));
}

}  // namespace
