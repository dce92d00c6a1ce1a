// Tables of measured points: what is refused, with file, line, value and cure; which cycles are kept.
#include "tunica/stages/fit/fit.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shared_folder.hpp"
#include "tunica/stages/fit/measured.hpp"
#include "tunica/stages/fit/remarks.hpp"

namespace tunica::stages {
namespace {

using test::message_of;

/// A strip and its file; run on rank 0.
struct Measured : testing::Test {
  test::SharedFolder folder;
  bool first = parallel::rank(MPI_COMM_WORLD) == 0;

  std::vector<fitting::Protocol> read(const std::string& table, const std::string& more = "unit: kPa",
                                      const std::string& stress = "force per area") const {
    folder.write("pull.csv", table);
    const auto file = folder.write(
        "fit.yaml",
        "specimens: {strip: {tests: {pull: {uniaxial: {along: e1}, file: pull.csv, load: stretch, stress: \"" + stress +
            "\", measure: cauchy, " + more + "}}}}\nlaws: {soft: neo_hooke}\n");
    if (!first) return {};
    return read_protocols(case_file::read_fit_case(file).value);
  }
  /// The message of the error that a table makes, or nothing on other ranks.
  std::string refusal(const std::string& table, const std::string& more = "unit: kPa") const {
    return message_of<InputError>([&] { read(table, more); });
  }
};

TEST_F(Measured, TheSchemaIsSound) {
  EXPECT_EQ(config::audit(*case_file::FitCase::schema().description()), std::vector<std::string>{});
}

TEST_F(Measured, BadValuesAreNamedWithLineAndCure) {
  const std::string header = "stretch,force per area\n1.0,0\n1.1,10\n";
  const std::pair<std::string, std::vector<std::string>> tables[] = {
      {"1.2,NaN\n", {"pull.csv:4", "'NaN'", "remove the row"}},
      {"-0.2,20\n", {"pull.csv:4", "'-0.2'", "engineering_strain"}},
      {"20,20\n", {"pull.csv:4", "percent"}},
      {"", {"pull.csv:2", "2 rows", "at least 3"}},
      {"1.2,1e9\n", {"pull.csv:4", "unit"}}};
  for (const auto& [row, parts] : tables) {
    const std::string message = refusal(header + row);
    if (!first) continue;
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
  }
}

TEST_F(Measured, AHeaderThatNamesAnotherUnitIsRefused) {
  const std::string message =
      message_of<InputError>([&] { read("stretch,P [MPa]\n1,0\n1.1,1\n1.2,2\n", "unit: kPa", "P [MPa]"); });
  if (!first) return;
  EXPECT_NE(message.find("names MPa"), std::string::npos) << message;
}

TEST_F(Measured, PreconditioningIsDropped) {
  std::string table = "stretch,force per area\n";
  for (const int cycle : {1, 2, 3})
    for (const double s : {1.0, 1.05, 1.1, 1.15, 1.2, 1.14, 1.07, 1.01})
      table += fmt::format("{},{}\n", s, 100.0 * (s - 1.0) / cycle);
  const auto protocols = read(table, "unit: kPa, cycles: {last_only: true, branch: loading}");
  if (!first) return;
  ASSERT_EQ(protocols.size(), 1u);
  ASSERT_GE(protocols[0].rows.size(), 5u);
  EXPECT_NEAR(protocols[0].rows.back().along, 1.2, 1e-12);
  EXPECT_NEAR(protocols[0].rows.back().stress[0], 1e3 * 20.0 / 3.0, 1e-6);
}

TEST_F(Measured, WhatATestLacksOrHasTooMuchIsAnError) {
  const auto file =
      folder.write("wrong.yaml",
                   "specimens:\n"
                   "  s:\n"
                   "    tests:\n"
                   "      a: {biaxial: {}, file: wrong.yaml, load: x, stress: y, unit: kPa, measure: cauchy}\n"
                   "      b: {uniaxial: {}, file: wrong.yaml, stress: y, unit: kPa, measure: cauchy}\n"
                   "      c: {gradients: {}, file: wrong.yaml, load: x, stress: y, unit: kPa, measure: cauchy}\n"
                   "      d: {uniaxial: {}, file: wrong.yaml, load: x, stress: y, unit: N, measure: force}\n"
                   "laws: {soft: neo_hooke}\n");
  if (!first) return;
  const std::string message = message_of<InputError>([&] { case_file::read_fit_case(file); });
  for (const char* part : {"tests.a.load_across", "tests.b.load", "tests.c.load", "tests.d.section"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
}

TEST_F(Measured, GradientsThatDoNotKeepTheVolumeAreRefusedAndSmallSlipsRepaired) {
  const std::string header = "F11,F12,F13,F21,F22,F23,F31,F32,F33,P1\n1,0,0,0,1,0,0,0,1,0\n";
  const auto case_of = [&](const std::string& table) {
    folder.write(table + ".csv", header + "1.1,0,0,0,1,0,0,0,0.91,9\n1.2,0,0,0,1,0,0,0," +
                                     (table == "sheet" ? "0.9" : "0.84") + ",18\n");
    return folder.write(table + ".yaml", "specimens: {s: {tests: {sheet: {gradients: {}, file: " + table +
                                             ".csv, stress: P1, measure: cauchy, unit: kPa}}}}\n"
                                             "laws: {soft: neo_hooke}\n");
  };
  const auto file = case_of("sheet"), slips = case_of("slips");  // collective
  if (!first) return;
  const std::string message = message_of<InputError>([&] { read_protocols(case_file::read_fit_case(file).value); });
  EXPECT_NE(message.find("sheet.csv:4"), std::string::npos) << message;
  EXPECT_NE(message.find("determinant 1.08"), std::string::npos) << message;
  const auto remarks = remarks_on_data(read_protocols(case_file::read_fit_case(slips).value));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("0.8 % from 1"), std::string::npos) << remarks[0];
}

TEST_F(Measured, AFitWritesAMaterialThatACaseReads) {
  std::string table = "stretch,force per area\n";
  for (const double s : {1.02, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3})
    table += fmt::format("{},{:.10g}\n", s, 40.0 * (s * s - 1.0 / s));
  read(table);
  const auto file = folder.write("law.yaml", "fitted: results/soft.yaml\n");
  if (!first) return;
  const auto screen = folder.path() / "screen.txt";
  std::FILE* out = std::fopen(screen.c_str(), "w");
  run_fit(folder.path() / "fit.yaml", std::nullopt, out);
  std::fclose(out);
  EXPECT_NE(test::slurp(screen).find("no test stretches along e2"), std::string::npos) << test::slurp(screen);
  EXPECT_NE(test::slurp(folder.path() / "results/fit.html").find("stretches in vivo"), std::string::npos);
  const auto law = config::parse_file(wall::law_schema(), file).value;
  EXPECT_NEAR(wall::matrix_shear_modulus(law), 40e3, 40.0);
}

}  // namespace
}  // namespace tunica::stages
