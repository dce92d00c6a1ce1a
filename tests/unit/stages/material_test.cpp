// Material files: what they accept, the curves, the tables, the comparison with measured points.
#include "tunica/stages/material/material.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "shared_folder.hpp"
#include "tunica/files/csv_file.hpp"
#include "tunica/stages/material/commands.hpp"

namespace tunica::stages {
namespace {

using test::message_of;

const std::string soft = "material: {neo_hooke: {shear_modulus: 50 kPa, poisson_ratio: 0.5}}\n";
const std::string fibres =
    "material:\n  hgo: {shear_modulus: 20 kPa, bulk_modulus: 1 MPa, families: [{k1: 30 kPa, k2: 5, mean_angle: 35 "
    "deg}]}\n";

/// A file and its folder of results; run on rank 0.
struct Material : testing::Test {
  test::SharedFolder folder;
  bool first = parallel::rank(MPI_COMM_WORLD) == 0;

  /// Returns what goes to the screen.
  std::string run(const std::string& text) const {
    const auto file = folder.write("material.yaml", text), screen = folder.path() / "screen.txt";
    if (!first) return {};
    std::FILE* out = std::fopen(screen.c_str(), "w");
    try {
      run_material(file, std::nullopt, out);
    } catch (...) {
      std::fclose(out);
      throw;
    }
    std::fclose(out);
    return test::slurp(screen);
  }
  files::CsvColumns table(const std::string& name) const {
    return files::read_csv(folder.path() / "results" / (name + ".csv"), "the test writes it");
  }
};

TEST_F(Material, TheSchemaIsSound) {
  EXPECT_EQ(config::audit(*case_file::MaterialCase::schema().description()), std::vector<std::string>{});
}

TEST_F(Material, EveryTestGivesItsTableAndPlot) {
  const std::string screen = run(soft +
                                 "tests:\n"
                                 "  pull: {uniaxial: {along: {angle: 30 deg}, to: 1.3, steps: 3}}\n"
                                 "  push: {uniaxial: {along: {vector: [1, 1, 1]}, from: 0.9, to: 0.8, steps: 1}}\n"
                                 "  equal: {equibiaxial: {to: 1.2}}\n"
                                 "  two: {biaxial: {along: e2, across: e3, to: 1.2, to_across: 1.1}}\n"
                                 "  wide: {planar: {along: e3, across: e1, to: 1.2}, measure: first_piola_kirchhoff}\n"
                                 "  slide: {simple_shear: {along: e1, across: e3, from: -0.1, to: 0.5}}\n"
                                 "  given: {gradients: {list: [[1.1, 0.1, 0, 0, 1, 0, 0, 0, 0.9090909]]}}\n");
  if (!first) return;
  for (const char* name : {"pull", "push", "equal", "two", "wide", "slide", "given"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results" / (std::string(name) + ".svg"))) << name;
    EXPECT_NE(screen.find(std::string(name) + ": "), std::string::npos) << name;
  }
  const files::CsvColumns pull = table("pull");
  EXPECT_EQ(pull.headers.size(), 2u + 9 + 1 + 2 + 6 + 6 + 1 + 21);
  ASSERT_EQ(pull.columns[0].size(), 4u);
  const double l = 1.3, sigma = 50.0 * (l * l - 1.0 / l);
  EXPECT_EQ(pull.column("stretch").back(), l);
  EXPECT_NEAR(pull.column("sigma11 [kPa]").back(), 0.75 * sigma, 1e-7);
  EXPECT_NEAR(pull.column("P along [kPa]").back(), sigma / l, 1e-7);
  EXPECT_NEAR(pull.column("Psi [kPa]").back(), 25.0 * (l * l + 2.0 / l - 3.0), 1e-7);
  EXPECT_NEAR(pull.column("J").back(), 1.0, 1e-10);
  EXPECT_EQ(table("push").column("stretch").front(), 0.9);
  const files::CsvColumns two = table("two");
  EXPECT_NEAR(two.column("F22").back(), 1.2, 1e-10);
  EXPECT_NEAR(two.column("F33").back(), 1.1, 1e-10);
  EXPECT_NEAR(two.column("P across [kPa]").back(), two.column("sigma33 [kPa]").back() / 1.1, 1e-7);
  EXPECT_NEAR(table("wide").column("F11").back(), 1.0, 1e-10);
  EXPECT_NEAR(table("slide").column("sigma13 [kPa]").back(), 25.0, 1e-7);
  EXPECT_NEAR(table("slide").column("F13").front(), -0.1, 1e-10);
}

/// CC is held against S at the printed digits, so that columns cannot be mixed up.
TEST_F(Material, TheTangentBelongsToTheStress) {
  run(fibres +
      "tests:\n"
      "  given:\n"
      "    gradients:\n"
      "      list:\n"
      "        - [1.1, 0.05, -0.02, 0.03, 1.07, 0.04, 0.01, -0.06, 0.98]\n"
      "        - [1.1, 0.05, -0.02, 0.03, 1.07, 0.04, 0.01, -0.06, 0.98001]\n");
  if (!first) return;
  const files::CsvColumns t = table("given");
  const auto strain = [&](int row, int i, int j) {
    double sum = 0.0;
    for (int k = 1; k <= 3; ++k)
      sum += 0.5 * t.column(fmt::format("F{}{}", k, i))[row] * t.column(fmt::format("F{}{}", k, j))[row];
    return sum;
  };
  const std::string voigt[] = {"11", "22", "33", "12", "23", "13"};
  for (int m = 0; m < 6; ++m) {
    double expected = 0.0;
    for (int n = 0; n < 6; ++n) {
      const int i = voigt[n][0] - '0', j = voigt[n][1] - '0';
      const std::string name = fmt::format("CC{}{} [kPa]", voigt[std::min(m, n)], voigt[std::max(m, n)]);
      expected +=
          (n < 3 ? 1.0 : 2.0) * 0.5 * (t.column(name)[0] + t.column(name)[1]) * (strain(1, i, j) - strain(0, i, j));
    }
    const auto& S = t.column(fmt::format("S{} [kPa]", voigt[m]));
    EXPECT_NEAR(S[1] - S[0], expected, 1e-4 * 0.01) << voigt[m];
  }
}

TEST_F(Material, MeasuredPointsAreComparedWhereTheyAre) {
  // On the curve of mu = 50 kPa, but 1 and -1 kPa beside it, and not in order.
  const auto cauchy = [](double l) { return 50.0 * (l * l - 1.0 / l); };
  std::string data = "# measured\nstretch, force per area\n";
  for (const auto& [l, off] : {std::pair{1.25, 1.0}, {1.05, -1.0}, {1.15, 1.0}, {1.35, -1.0}})
    data += std::to_string(l) + ", " + std::to_string(cauchy(l) + off) + "\n";
  folder.write("pull.csv", data);
  const std::string screen = run(soft +
                                 "tests:\n  pull: {uniaxial: {to: 1.2}, data: {file: pull.csv, load: stretch, stress: "
                                 "force per area, unit: kPa}}\n");
  const std::string wrong_column = message_of<InputError>([&] {
    run(soft + "tests: {a: {uniaxial: {to: 1.2}, data: {file: pull.csv, load: stretch, stress: none, unit: kPa}}}\n");
  });
  if (!first) return;
  EXPECT_NE(screen.find("against 4 measured points: RMS deviation 1 kPa, R^2 0.99"), std::string::npos) << screen;
  EXPECT_NE(test::slurp(folder.path() / "results/pull.svg").find("measured"), std::string::npos);
  EXPECT_NE(wrong_column.find("choose from: stretch, force per area"), std::string::npos) << wrong_column;
}

TEST_F(Material, GradientsFromAFileAndOnTheScreen) {
  folder.write("path.csv", "time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n0,1,0,0,0,1,0,0,0,1\n1,1,0.2,0,0,1,0,0,0,1\n");
  const std::string screen = run(soft + "tests: {path: {gradients: {file: path.csv}}}\n");
  if (first) {
    EXPECT_NE(screen.find("F number 2: J 1, Psi 1 kPa"), std::string::npos) << screen;
    EXPECT_NEAR(table("path").column("sigma12 [kPa]").back(), 10.0, 1e-9);
  }
  folder.write("path.csv", "F11,F12,F13,F21,F22,F23,F31,F32,F33\n1.1,0,0,0,1,0,0,0,1\n");
  const auto message = message_of<InputError>([&] { run(soft + "tests: {path: {gradients: {file: path.csv}}}\n"); });
  EXPECT_EQ(message.find("incompressible") != std::string::npos, first) << message;
}

TEST_F(Material, AllErrorsAtOnce) {
  const std::string message = message_of<InputError>([&] {
    config::parse_text(case_file::MaterialCase::schema(),
                       soft +
                           "tests:\n"
                           "  a: {planar: {along: e1, across: {angle: 45 deg}, to: 1.2}}\n"
                           "  b: {uniaxial: {to: 1}}\n"
                           "  c: {biaxial: {to: 1.2}}\n"
                           "  d: {gradients: {list: [[1, 0, 0, 0, 1, 0, 0, 0, -1]]}}\n"
                           "  e: {gradients: {}}\n"
                           "  f: {uniaxial: {to: 1.2, stpes: 3}}\n"
                           "  g: {uniaxial: {along: {vector: [0, 0, 0]}, to: 1.2}}\n"
                           "  h: {biaxial: {to: 1.2, ratio: 1, to_across: 1}}\n");
  });
  for (const char* part :
       {"is not perpendicular", "is where the path begins", "the second stretch is not given", "has the determinant -1",
        "no deformation gradient is given", "stpes", "has length zero", "`to_across` and `ratio` are both given"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;

  const std::string whole = message_of<InputError>([&] {
    config::parse_text(case_file::MaterialCase::schema(),
                       soft + "incompressible: false\ntests: {../a: {uniaxial: {to: 1.2}}}\n");
  });
  EXPECT_NE(whole.find("no finite bulk modulus"), std::string::npos) << whole;
  EXPECT_NE(whole.find("becomes the name of a file"), std::string::npos) << whole;
}

TEST_F(Material, IncompressibleOverridesTheBulkModulus) {
  const auto parsed = config::parse_text(case_file::MaterialCase::schema(),
                                         fibres + "incompressible: true\ntests: {a: {uniaxial: {to: 1.2}}}\n");
  EXPECT_FALSE(std::isfinite(parsed.value.volumetric().bulk_modulus));
  const auto as_given =
      config::parse_text(case_file::MaterialCase::schema(), fibres + "tests: {a: {uniaxial: {to: 1.2}}}\n");
  EXPECT_EQ(as_given.value.volumetric().bulk_modulus, 1e6);
}

TEST_F(Material, FailureNamesTestAndPoint) {
  const std::string text =
      "material: {hgo: {shear_modulus: 20 kPa, poisson_ratio: 0.5, families: [{k1: 30 kPa, k2: 100, mean_angle: 0 "
      "deg}]}}\n"
      "tests: {far: {uniaxial: {to: 9, steps: 2}}}\n";
  const auto message = message_of<SolverError>([&] { run(text); });
  const bool told = message.find("test far, point 2: no equilibrium at a stretch of 5") != std::string::npos;
  EXPECT_EQ(told, first) << message;
}

}  // namespace
}  // namespace tunica::stages
