#include "tunica/config/schema.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>

#include "tunica/base/tensor.hpp"

namespace tunica::config {
namespace {

struct Soft {
  double modulus = 0.0;
  static Schema<Soft> schema() {
    return Schema<Soft>("soft", "Soft law.")
        .quantity("modulus", &Soft::modulus, dimension::pressure, above(0), "Stiffness");
  }
};
struct Rigid {
  static Schema<Rigid> schema() { return {"rigid", "Does not deform."}; }
};
using Law = std::variant<double, Soft, Rigid>;
Schema<Law> law_schema() {
  return Schema<Law>("law", "Material law.")
      .one_of()
      .quantity("spring", emplace<double>, dimension::stiffness_per_area, above(0), "Spring")
      .alternative(Soft::schema())
      .alternative(Rigid::schema());
}

enum class Cells { open, closed };
struct Layer {
  double thickness = 1e-3;
  int parts = 2;
  static Schema<Layer> schema() {
    return Schema<Layer>("layer", "A layer.")
        .quantity("thickness", &Layer::thickness, dimension::length, above(0), "Thickness")
        .by_default()
        .integer("parts", &Layer::parts, at_least(1), "Elements across")
        .by_default("3")
        .shorthand("thickness");
  }
};
struct Foam {
  double density = 0.0;
  double damping = 0.25;
  std::optional<double> yield;
  Cells cells = Cells::closed;
  bool wet = true;
  std::string label;
  std::vector<std::string> tags;
  std::filesystem::path table, results;
  Vec3<double> pull{{0, 0, 1}};
  std::vector<double> times;
  std::array<bool, 3> axes{true, false, true};
  double time_unit = 1.0;
  Law law;
  std::optional<Layer> skin;
  Layer core;
  std::vector<Layer> layers;
  std::vector<std::pair<std::string, Law>> faces;
  static Schema<Foam> schema() {
    return Schema<Foam>("foam", "Elastic foam.")
        .quantity("density", &Foam::density, dimension::density, above(0), "Density")
        .plausible("900 kg/m^3", "1300 kg/m^3")
        .number("damping", &Foam::damping, from_to_below(0, 0.5), "Damping")
        .by_default()
        .quantity("yield", &Foam::yield, dimension::pressure, above(0), "Yield stress")
        .choice("cells", &Foam::cells, {{"open", Cells::open}, {"closed", Cells::closed}}, "Cells")
        .by_default()
        .flag("wet", &Foam::wet, "Wet")
        .by_default()
        .text("label", &Foam::label, "Label")
        .by_default("none")
        .texts("tags", &Foam::tags, "Tags")
        .by_default()
        .file("table", &Foam::table, "Table")
        .optional()
        .path("results", &Foam::results, "Results")
        .by_default("out")
        .quantities("pull", &Foam::pull, dimension::force, anything(), "Pull")
        .by_default()
        .quantities("times", &Foam::times, dimension::time, at_least(0), "Times")
        .by_default("[]")
        .any_of("axes", &Foam::axes, {"x", "y", "z"}, "Axes")
        .by_default()
        .unit("time_unit", &Foam::time_unit, dimension::time, "Unit")
        .by_default("ms")
        .section("law", &Foam::law, law_schema(), "Law")
        .by_default("rigid")
        .section("skin", &Foam::skin, Layer::schema(), "Skin")
        .section("core", &Foam::core, Layer::schema(), "Core")
        .by_default()
        .list("layers", &Foam::layers, Layer::schema(), "Layers")
        .by_default()
        .map("faces", &Foam::faces, law_schema(), "Faces")
        .by_default()
        .check([](const Foam& f, Problems& problems) {
          if (f.skin && f.cells == Cells::open) problems.add("skin", "open cells have no skin", "leave it out");
          if (f.wet && f.density > 1200) problems.warn("", "heavy and wet", "dry it");
        });
  }
};

std::vector<Problem> problems_of(const std::string& yaml, const Origin& origin = {}) {
  try {
    parse_text(Foam::schema(), yaml, origin);
  } catch (const InputError& error) {
    return error.problems();
  }
  ADD_FAILURE() << "accepted:\n" << yaml;
  return {};
}
Problem problem_of(const std::string& yaml) {
  const auto problems = problems_of("density: 1 g/cm^3\n" + yaml);
  EXPECT_EQ(problems.size(), 1u) << yaml;
  return problems.empty() ? Problem{} : problems.front();
}
Foam foam(const std::string& yaml) { return parse_text(Foam::schema(), "density: 1 g/cm^3\n" + yaml).value; }

TEST(Schema, DescriptionOfTheseTestsIsSound) {
  EXPECT_EQ(audit(*Foam::schema().description()), std::vector<std::string>{});
}

TEST(Schema, DefaultsFillWhatIsLeftOut) {
  const Foam f = foam("");
  EXPECT_DOUBLE_EQ(f.density, 1000.0);
  EXPECT_EQ(f.damping, 0.25);
  EXPECT_FALSE(f.yield);
  EXPECT_EQ(f.cells, Cells::closed);
  EXPECT_TRUE(f.wet);
  EXPECT_EQ(f.label, "none");
  EXPECT_EQ(f.pull[2], 1.0);
  EXPECT_EQ(f.axes, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(f.time_unit, 1e-3);
  EXPECT_TRUE(std::holds_alternative<Rigid>(f.law));
  EXPECT_FALSE(f.skin);
  EXPECT_EQ(f.core.parts, 3);
}

TEST(Schema, ReadsEveryKind) {
  const Foam f = foam(R"(
damping: 0.4
yield: 2 kPa
cells: open
wet: false
label: blue
tags: [a, b]
pull: "[1, 0, -2] N"
times: [1 s, 20 ms]
axes: [y]
time_unit: 0.9 s
law: {soft: {modulus: 3 Pa}}
core: 2 mm
layers: [{thickness: 1 cm, parts: 7}, 3 cm]
faces:
  left: rigid
  right: {spring: 4 N/m^3}
  top: {rigid: }
)");
  EXPECT_EQ(f.damping, 0.4);
  EXPECT_EQ(f.yield, 2e3);
  EXPECT_EQ(f.cells, Cells::open);
  EXPECT_FALSE(f.wet);
  EXPECT_EQ(f.label, "blue");
  EXPECT_EQ(f.tags, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(foam("tags: a").tags, std::vector<std::string>{"a"});
  EXPECT_EQ(f.pull[0], 1.0);
  EXPECT_EQ(f.pull[2], -2.0);
  EXPECT_EQ(f.times, (std::vector<double>{1.0, 0.02}));
  EXPECT_EQ(f.axes, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(f.time_unit, 0.9);
  EXPECT_EQ(std::get<Soft>(f.law).modulus, 3.0);
  EXPECT_EQ(f.core.thickness, 2e-3);
  ASSERT_EQ(f.layers.size(), 2u);
  EXPECT_EQ(f.layers[0].parts, 7);
  EXPECT_DOUBLE_EQ(f.layers[1].thickness, 0.03);
  ASSERT_EQ(f.faces.size(), 3u);
  EXPECT_EQ(f.faces[1].first, "right");
  EXPECT_EQ(std::get<double>(f.faces[1].second), 4.0);
  EXPECT_TRUE(std::holds_alternative<Rigid>(f.faces[2].second));
}

TEST(Schema, ReportsAllErrorsAtOnceWithPathLineAndRemedy) {
  const auto problems = problems_of(
      "damping: 0.5\nlaw:\n  soft:\n    modulos: 3 Pa\nlabel: a\nlabel: b\ncore:\n  parts: 0\n", {.name = "try.yaml"});
  std::vector<std::string> texts;
  for (const Problem& p : problems) texts.push_back(p.where + " | " + p.what + " | " + p.remedy);
  const std::vector<std::string> expected = {
      "label (try.yaml:6) | stands twice, first in line 5 | keep one of them",
      "top level (try.yaml:1) | `density` is missing: Density (> 0 kg/m^3) | add `density: <number> kg/m^3`",
      "damping (try.yaml:1) | `0.5` is out of range, allowed: >= 0 and < 0.5 | give a value >= 0 and < 0.5",
      "law.soft.modulos (try.yaml:4) | `modulos` is not known here | did you mean `modulus`?",
      "law.soft (try.yaml:3) | `modulus` is missing: Stiffness (> 0 Pa) | add `modulus: <number> Pa`",
      "core.parts (try.yaml:8) | `0` is out of range, allowed: >= 1 and <= 2147483647 | give a value >= 1 and <= "
      "2147483647",
  };
  EXPECT_EQ(texts, expected);
}

TEST(Schema, RefusesWrongValues) {
  EXPECT_EQ(problem_of("yield: 3").what, "`3` has no unit; a pressure or stress is due");
  EXPECT_EQ(problem_of("yield: -3 Pa").what, "`-3 Pa` is out of range, allowed: > 0 Pa");
  EXPECT_EQ(problem_of("yield: [3 Pa]").what, "is a list; a single value is due: Yield stress");
  EXPECT_EQ(problem_of("core: {parts: 2.0}").what, "`2.0` is not a whole number");
  EXPECT_EQ(problem_of("wet: yes").what, "`yes` is neither true nor false");
  EXPECT_EQ(problem_of("cells: opne").remedy, "did you mean `open`?");
  EXPECT_EQ(problem_of("tags: [[a]]").what, "is a list; a text or a list of texts is due");
  EXPECT_EQ(foam("axes: z").axes, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(problem_of("axes: [x, w]").what, "`w` is not one of: x, y, z");
  EXPECT_EQ(problem_of("pull: [1 N, 2 N]").what, "has 2 values; 3 are due");
  EXPECT_EQ(problem_of("pull: [1 N, 2 N, 3]").where, "pull[3] (case.yaml:2)");
  EXPECT_EQ(problem_of("pull: 1 N").what, "is a single value; a list of 3 values is due");
  EXPECT_EQ(problem_of("time_unit: 0 s").what, "`0 s` is out of range, allowed: > 0 s");
  EXPECT_EQ(problem_of("layers: {thickness: 1 m}").what, "is a section with keys; a list is due");
  EXPECT_EQ(problem_of("faces: 3").what, "is a single value; named sections are due");
  EXPECT_EQ(problem_of("faces: {a: rigid, a: rigid}").where, "faces.a (case.yaml:2)");
  EXPECT_EQ(problem_of("[1, 2]: 3").what, "a key is a list");
}

TEST(Schema, ExactlyOneAlternative) {
  EXPECT_EQ(problem_of("law: {}").remedy, "give exactly one of: spring, soft, rigid");
  EXPECT_EQ(problem_of("law: {rigid: {}, spring: 1 N/m^3}").what,
            "has 2 of law that exclude each other: spring, rigid");
  EXPECT_EQ(problem_of("law: stiff").what, "`stiff` is not known here");
  EXPECT_EQ(problem_of("law: soft").where, "law.soft (case.yaml:2)");
}

TEST(Schema, IncludedKeysStandOnTheSameLevel) {
  struct Wall {
    Law law;
    double density = 0.0;
  };
  const auto schema = Schema<Wall>("wall", "Wall.")
                          .quantity("density", &Wall::density, dimension::density, above(0), "Density")
                          .include(&Wall::law, law_schema());
  const Wall wall = parse_text(schema, "density: 1 g/cm^3\nsoft: {modulus: 5 Pa}").value;
  EXPECT_EQ(std::get<Soft>(wall.law).modulus, 5.0);
  EXPECT_THROW(parse_text(schema, "density: 1 g/cm^3"), InputError);
}

TEST(Schema, ChecksSeeTheWholeSectionAndNameTheLine) {
  const Problem problem = problem_of("cells: open\nskin: 1 mm\n");
  EXPECT_EQ(problem.where, "skin (case.yaml:3)");
  EXPECT_EQ(problem.what, "open cells have no skin");
}

TEST(Schema, WarnsOfUnitSlips) {
  const auto warnings = parse_text(Foam::schema(), "density: 1.06 kg/m^3").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].what, "`1.06 kg/m^3` is unusual: 900 kg/m^3 to 1300 kg/m^3 is expected");
  EXPECT_EQ(warnings[0].remedy, "a slip of the unit? `1.06 g/cm^3` would be usual");
  EXPECT_EQ(parse_text(Foam::schema(), "density: 1250 kg/m^3").warnings.at(0).what, "heavy and wet");
}

TEST(Schema, ValuesThatNoNumberHoldsAreErrorsWithTheirLine) {
  const Problem problem = problem_of("yield: 1e-320 Pa\n");
  EXPECT_EQ(problem.where, "yield (case.yaml:2)");
  EXPECT_EQ(problem.what, "`1e-320 Pa` is too close to 0 for a number");
  EXPECT_EQ(parse_text(Foam::schema(), "density: 3e-308 kg/m^3").warnings.size(), 1u);
}

TEST(Schema, PathsAreRelativeToTheCaseFileAndMustExist) {
  const auto folder = std::filesystem::temp_directory_path() / "tunica_schema_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "flow.csv") << "t,q\n";
  std::ofstream(folder / "case.yaml") << "density: 1 g/cm^3\ntable: flow.csv\n";
  const Foam read = parse_file(Foam::schema(), folder / "case.yaml").value;
  EXPECT_EQ(read.table, folder / "flow.csv");
  EXPECT_EQ(read.results, folder / "out");
  const Origin origin{.name = "case.yaml", .folder = folder};
  const auto problems = problems_of("density: 1 g/cm^3\ntable: flwo.csv\n", origin);
  EXPECT_EQ(problems.at(0).remedy, "did you mean `flow.csv`?");
  EXPECT_NO_THROW(parse_text(Foam::schema(), "density: 1 g/cm^3\ntable: a.csv", {.check_files = false}));
  std::filesystem::remove_all(folder);
  EXPECT_THROW(parse_file(Foam::schema(), folder / "case.yaml"), InputError);
}

TEST(Schema, SaysWhatStandsUnderANameThatIsNoFile) {
  namespace fs = std::filesystem;
  const auto folder = fs::temp_directory_path() / "tunica_schema_kinds_test";
  fs::remove_all(folder);
  fs::create_directories(folder / "d.csv");
  fs::create_symlink("loop.csv", folder / "loop.csv");
  fs::create_symlink("gone.csv", folder / "broken.csv");
  const auto problem = [&](const std::string& name) {
    return problems_of("density: 1 g/cm^3\ntable: " + name + "\n", {.name = "case.yaml", .folder = folder}).at(0);
  };
  EXPECT_EQ(problem("d.csv").what, "`d.csv` is a folder, a file is due");
  EXPECT_EQ(problem("d.csv").remedy, "name a file");
  EXPECT_EQ(problem("/dev/null").what, "`/dev/null` is a device, a pipe or a socket, a file is due");
  EXPECT_EQ(problem("loop.csv").what, "`loop.csv` is a link that leads back to itself, a file is due");
  EXPECT_EQ(problem("broken.csv").what, "`broken.csv` is a link to gone.csv, which is not there, a file is due");
  fs::remove_all(folder);
}

TEST(Schema, EmptyNamesOfFilesAndFoldersAreRefused) {
  for (const Origin& origin :
       {Origin{.name = "case.yaml", .folder = ""}, Origin{.name = "case.yaml", .folder = "/tmp"}})
    for (const char* key : {"table", "results"}) {
      const auto problems = problems_of("density: 1 g/cm^3\n" + std::string(key) + ": \"\"\n", origin);
      ASSERT_EQ(problems.size(), 1u);
      EXPECT_EQ(problems[0].where, std::string(key) + " (case.yaml:2)");
      EXPECT_NE(problems[0].what.find("is empty; a name is due"), std::string::npos) << problems[0].what;
      EXPECT_NE(problems[0].remedy.find("write a name"), std::string::npos) << problems[0].remedy;
    }
}

TEST(Schema, LineEndsOfAnySystem) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string e = end;
    const Foam read = parse_text(Foam::schema(), "# a foam" + e + "density: 1 g/cm^3" + e + "label: |" + e + "  a" + e +
                                                     "  b" + e + "skin: 2 mm" + e)
                          .value;
    EXPECT_DOUBLE_EQ(read.density, 1000);
    EXPECT_EQ(read.label, "a\nb\n");
    const auto problems = problems_of("density: 1 g/cm^3" + e + e + "lable: a" + e);
    EXPECT_EQ(problems.at(0).where, "lable (case.yaml:3)");
  }
}

TEST(Schema, SyntaxErrorsNameLineAndColumn) {
  const auto problems = problems_of("density: 1 g/cm^3\nlaw: {soft: [}\n", {.name = "try.yaml"});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "try.yaml:2:14");
  EXPECT_NE(problems_of("a: 1\n---\nb: 2\n").at(0).what.find("2 YAML documents"), std::string::npos);
}

TEST(Schema, AuditFindsSlipsInADescription) {
  struct Slips {
    Layer layer;
    Law law;
    std::string label;
  };
  const auto schema =
      Schema<Slips>("slips", "Slips.")
          .quantity(
              "thickness", [](Slips& s) -> double& { return s.layer.thickness; }, dimension::length, above(0), "")
          .by_default("3")
          .text("label", &Slips::label, "Label")
          .by_default()
          .text("label", &Slips::label, "Label again")
          .section("law", &Slips::law, law_schema(), "Law")
          .by_default()
          .shorthand("size");
  EXPECT_EQ(audit(*schema.description()).size(), 5u);
}

}  // namespace
}  // namespace tunica::config
