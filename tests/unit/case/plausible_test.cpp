#include "tunica/case/plausible.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "temporary_folder.hpp"
#include "tunica/case/case.hpp"

namespace tunica::case_file {
namespace {

class Plausible : public testing::Test {
 protected:
  /// A closed wave between `low` and `high` over a period.
  void write_wave(const std::string& name, double low, double high, double period, const char* header = "t,Q\n") const {
    std::string text = header;
    for (int k = 0; k <= 40; ++k)
      text += fmt::format("{},{:.6g}\n", period * k / 40,
                          low + 0.5 * (high - low) * (1 - std::cos(2 * std::numbers::pi * k / 40)));
    std::ofstream(folder_.path() / name) << text;
  }
  /// Warnings of a case with these conditions at inlet and outlet.
  std::vector<Problem> warnings(const std::string& inlet, const std::string& outlet = "{resistance: 1e8 Pa s/m^3}",
                                const std::string& time = "{step: 5 ms, steps: 8}") const {
    std::ofstream(folder_.path() / "case.yaml")
        << "analysis: flow\nmeshes: {tube: {radius: 1 cm, length: 5 cm}}\n"
           "fluid: {viscosity: {newtonian: {viscosity: 4 mPa s}}}\n"
           "boundary:\n  lumen_inlet: "
        << inlet << "\n  lumen_outlet: " << outlet << "\n  lumen_wall: no_slip\ntime: " << time << "\n";
    return read_case(folder_.path() / "case.yaml").warnings;
  }
  void expect_one(const std::vector<Problem>& found, const std::string& what, const std::string& remedy = "") const {
    ASSERT_EQ(found.size(), 1u) << (found.size() > 1 ? format(found[0]) + "\n" + format(found[1]) : what);
    EXPECT_NE(found[0].what.find(what), std::string::npos) << format(found[0]);
    EXPECT_NE(found[0].remedy.find(remedy), std::string::npos) << format(found[0]);
  }
  static std::string table(const char* unit, const char* time_unit = "s", const char* more = "") {
    return fmt::format("{{flow: {{table: {{file: q.csv, time_unit: {}, unit: {}}}{}}}}}", time_unit, unit, more);
  }
  test::TemporaryFolder folder_;
};

TEST_F(Plausible, UsualTablesPassWithoutAWord) {
  write_wave("q.csv", -20, 400, 0.8);
  EXPECT_TRUE(warnings(table("ml/s")).empty());
  write_wave("q.csv", 80, 120, 800);
  EXPECT_TRUE(warnings("{pressure: {table: {file: q.csv, time_unit: ms, unit: mmHg}}}").empty());
}

TEST_F(Plausible, FlowOfATable) {
  write_wave("q.csv", 1000, 4800, 0.8);
  expect_one(warnings(table("ml/s")), "reaches 4800 ml/s; 0.01 ml/s to 1000 ml/s is usual", "4800 ml/min");
  expect_one(warnings(table("ml/min", "s", ", scale: 60")), "reaches 4800 ml/s");
  write_wave("q.csv", 1e-5, 4e-4, 0.8);
  expect_one(warnings(table("ml/s")), "reaches 0.0004 ml/s", "0.0004 m^3/s");
}

TEST_F(Plausible, FinenessOfAMeshToBeMade) {
  const auto found = [&](const std::string& size, const std::string& more) {
    std::ofstream(folder_.path() / "case.yaml")
        << "analysis: fsi\nmesh: {geometry: {parametric: {}}, size: " << size << "}\n"
        << more
        << "fluid: {}\nwall: {density: 1100 kg/m^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: "
           "0.45}}}\n"
           "boundary: {lumen_inlet: {flow: 20 ml/s}, \"lumen_*\": {resistance: 1e8 Pa s/m^3}, \"wall_*\": fixed}\n"
           "time: {step: 1 ms, steps: 2}\n";
    return read_case(folder_.path() / "case.yaml").warnings;
  };
  const std::string linear = "elements: linear\n";
  EXPECT_TRUE(found("medium", "").empty());
  EXPECT_TRUE(found("{edge: 3 mm}", "").empty());
  EXPECT_TRUE(found("{elements_across: 10}", linear).empty());
  expect_one(found("coarse", ""), "2.5 elements across the lumen are asked for; flow on quadratic ones needs 4",
             "mesh.size: {elements_across: 4}");
  expect_one(found("medium", linear), "4 elements across the lumen are asked for; flow on linear ones needs 10",
             "`elements: quadratic`");
}

TEST_F(Plausible, PressureOfATable) {
  write_wave("q.csv", 8000, 16000, 0.8);
  const char* kilopascals = "{pressure: {table: {file: q.csv, time_unit: s, unit: kPa}}}";
  expect_one(warnings(kilopascals), "the pressure of the table reaches", "16000 Pa");
  write_wave("q.csv", 80, 120, 0.8);
  expect_one(warnings("{pressure: {table: {file: q.csv, time_unit: s, unit: Pa}}}"), "reaches 0.9001 mmHg", "120 mmHg");
}

TEST_F(Plausible, VelocityAndTractionByTable) {
  write_wave("q.csv", 0, 30, 0.8);
  expect_one(warnings("{velocity: {value: \"[0, 0, 1] m/s\", waveform: {table: {file: q.csv, time_unit: s}}}}"),
             "the velocity of the table reaches 30 m/s");
  expect_one(warnings("{traction: {value: \"[0, 0, 100] mmHg\", waveform: {table: {file: q.csv, time_unit: s}}}}"),
             "the traction of the table reaches 3000 mmHg");
}

TEST_F(Plausible, ConstantsAndStepsWithTheirScale) {
  expect_one(warnings("{flow: {step: {value: 5 L/s}}}"), "`5 L/s` = 0.005 m^3/s is unusual");
  expect_one(warnings("{pressure: {step: {value: 16 MPa}}}"), "`16 MPa`", "would be usual");
  expect_one(warnings("{flow: {value: 1 L/s, scale: 5}}"), "the flow reaches 5000 ml/s with its scale");
  expect_one(warnings("{flow: {step: {value: -1 L/s}, scale: -5}}"), "the flow reaches 5000 ml/s with its scale");
  expect_one(warnings("{pressure: {value: 100 mmHg, scale: 133}}"), "the pressure reaches 1.33e+04 mmHg");
  expect_one(warnings("{pressure: {step: {value: 16 MPa}, scale: 3}}"), "is unusual");  // once, as it was typed
  expect_one(warnings("{velocity: {value: \"[0, 0, 1] m/s\", waveform: {step: {value: 30}}}}"),
             "the velocity reaches 30 m/s with its waveform");
  expect_one(warnings("{traction: {value: \"[0, 0, 100] mmHg\", waveform: {value: 1, scale: 30}}}"),
             "the traction reaches 3000 mmHg");
  expect_one(warnings("{velocity: {value: \"[0, 0, 30] m/s\", waveform: {step: {value: 3}}}}"), "is unusual");
  for (const char* usual : {"{flow: {value: 60 L/min, scale: 1}}", "{flow: {step: {value: 100 ml/s}, scale: 2}}",
                            "{pressure: {value: 400 mmHg}}", "{pressure: {value: 100 mmHg, scale: 0}}"})
    EXPECT_TRUE(warnings(usual).empty()) << usual;
}

TEST_F(Plausible, PeriodOfATable) {
  write_wave("q.csv", 10, 100, 780);
  expect_one(warnings(table("ml/s")), "period of the table is 780 s; 0.2 s to 3 s is usual", "780 ms");
  write_wave("q.csv", 10, 100, 0.78);
  expect_one(warnings(table("ml/s", "ms")), "period of the table is 0.00078 s", "0.78 s");
}

TEST_F(Plausible, StepsInAPeriod) {
  write_wave("q.csv", 10, 100, 0.3);
  expect_one(warnings(table("ml/s"), "{resistance: 1e8 Pa s/m^3}", "{step: 18 ms, steps: 8}"), "16.7 steps of 0.018 s");
  write_wave("q.csv", 10, 100, 0.8);
  expect_one(warnings(table("ml/s"), "{resistance: 1e8 Pa s/m^3}", "{step: 0.1 s, steps: 8}"), "`0.1 s` is unusual");
}

TEST_F(Plausible, ATableThatOutlastsTheRun) {
  write_wave("q.csv", 10, 100, 800);
  expect_one(warnings("{flow: {table: {file: q.csv, time_unit: s, unit: ml/s, periodic: false}}}"),
             "the table lasts 800 s, the run 0.04 s");
}

TEST_F(Plausible, SignOfTheInflow) {
  write_wave("q.csv", -100, -10, 0.8);
  expect_one(warnings(table("ml/s")), "55 ml/s out of the vessel on average", "positive: outflow");
  expect_one(warnings("{flow: -20 ml/s}"), "20 ml/s out of the vessel");
  EXPECT_TRUE(warnings(table("ml/s", "s", ", positive: outflow")).empty());
  EXPECT_TRUE(warnings("{pressure: 80 mmHg}", "{flow: -20 ml/s}").empty());  // an outflow that is given
  write_wave("q.csv", -100, 300, 0.8);
  EXPECT_TRUE(warnings(table("ml/s")).empty());  // backflow is no error
}

TEST_F(Plausible, SimVascularTablesCountOutwards) {
  std::ofstream(folder_.path() / "q.flow") << "5 2\n0 10\n0.2 50\n0.4 80\n0.6 20\n0.8 10\n";
  expect_one(warnings("{flow: {table: {file: q.flow, time_unit: s, unit: ml/s}}}"), "out of the vessel");
}

TEST_F(Plausible, ResistancesThatNoHeartCouldOvercome) {
  expect_one(warnings("{flow: 90 ml/s}", "{resistance: 5e10 Pa s/m^3}"), "needs a mean pressure of");
  expect_one(warnings("{flow: 5 ml/s}", "{resistance: 5e12 Pa s/m^3}"), "is unusual");  // of the value alone
  expect_one(
      warnings("{flow: 90 ml/s}", "{rcr: {proximal: 1e9 Pa s/m^3, capacitance: 1e-11 m^3/Pa, distal: 5e10 Pa s/m^3}}"),
      "needs a mean pressure of");
  expect_one(
      warnings("{flow: 20 ml/s}", "{rcr: {proximal: 1e7 Pa s/m^3, capacitance: 5e-8 m^3/Pa, distal: 1e9 Pa s/m^3}}"),
      "time constant (distal x capacitance) of 50 s");
  for (const char* limit : {"1e12 Pa s/m^3", "1e7 dyn s/cm^5", "9.9e11 Pa s/m^3"}) {  // none is beyond it by itself
    const std::string rest = ", capacitance: 1e-8 m^3/Pa, distal: 1.2e8 Pa s/m^3}}";
    expect_one(warnings("{flow: 50 ml/s}", std::string("{rcr: {proximal: ") + limit + rest),
               "needs a mean pressure of");
    expect_one(warnings("{flow: 50 ml/s}", std::string("{resistance: ") + limit + "}"), "needs a mean pressure of");
  }
  EXPECT_TRUE(
      warnings("{flow: 20 ml/s}", "{rcr: {proximal: 1e7 Pa s/m^3, capacitance: 1e-9 m^3/Pa, distal: 1e9 Pa s/m^3}}")
          .empty());
}

TEST_F(Plausible, ResistancesThatLetNothingThrough) {
  expect_one(warnings("{pressure: 90 mmHg}", "{resistance: 5e11 Pa s/m^3}"), "drives 0.024 ml/s");
  EXPECT_TRUE(warnings("{pressure: 90 mmHg}", "{resistance: 1e9 Pa s/m^3}").empty());
  EXPECT_TRUE(warnings("{pressure: 1 mmHg}", "{resistance: 5e11 Pa s/m^3}").empty());  // no pressure of an artery
}

TEST(CaseNames, OfRegionsAndComparedLaws) {
  const auto message = [](const std::string& meshes, const std::string& more) {
    return test::message_of<InputError>([&] {
      parse_case("analysis: static_wall\nmeshes: " + meshes +
                     "\nwall: {density: 1 g/cm^3, material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}}}\n"
                     "boundary: {a: fixed}\n" +
                     more,
                 "case.yaml");
    });
  };
  const auto wall = [](const std::string& regions) {
    return "{length_unit: mm, wall: {simvascular: w, region_array: r, regions: " + regions + "}}";
  };
  EXPECT_NE(message(wall("{a/b: 1}"), "").find("the name 'a/b' of a region has the character '/'"), std::string::npos);
  EXPECT_NE(message(wall("{flap: 1, Flap: 2}"), "").find("in the case of letters only"), std::string::npos);
  EXPECT_NE(message("{length_unit: mm, gmsh: {file: m.msh, regions: {\"w*\": wall}}}", "").find("'w*'"),
            std::string::npos);
  const std::string law = "{material: {neo_hooke: {young_modulus: 1 MPa, poisson_ratio: 0.3}}}";
  EXPECT_NE(message(wall("{a: 1}"), "compare: {../up: " + law + "}\n").find("'../up' of a compared law"),
            std::string::npos);
}

}  // namespace
}  // namespace tunica::case_file
