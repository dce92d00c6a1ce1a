#include "tunica/case/fit_case.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "tunica/case/descriptions.hpp"
#include "tunica/case/keys.hpp"

namespace tunica::case_file {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

// --- tests --------------------------------------------------------------------------------------------------------

Schema<TestedSpecimen> fit_loading_schema() {
  return Schema<TestedSpecimen>("loading", "How the specimen was loaded.")
      .one_of()
      .alternative(Schema<PulledStrip>("uniaxial", "A strip pulled along one axis; its other faces are free.")
                       .section("along", &PulledStrip::along, direction_schema(), "Axis of the strip")
                       .by_default("e1"))
      .alternative(sheet_axes_schema<BiaxialTest>(
                       "biaxial",
                       "A sheet stretched along two axes, by given stretches or by given loads; its faces are free.",
                       "First axis", "Second axis")
                       .number("load_ratio", &BiaxialTest::load_ratio, config::range(-10, 10),
                               "Force per section at rest along the second axis over that along the first, where the "
                               "stretch of the second axis was not measured"))
      .alternative(sheet_axes_schema<PlanarTest>("planar",
                                                 "Planar tension, also called pure shear: stretched along one axis at "
                                                 "constant width; its faces are free.",
                                                 "Stretched axis", "Axis along which the width is held"))
      .alternative(sheet_axes_schema<ShearTest>("simple_shear", "F = I + shear a1 (x) a2.", "Direction a1 of the shear",
                                                "Normal a2 of the planes that slide"))
      .alternative(
          Schema<MeasuredGradients>("gradients",
                                    "A sheet whose deformation gradient was measured: columns F11, F12, F13, F21 ... "
                                    "F33 in the fibre frame, in place of `load`; the face across e3 is free.")
              .number("volume_tolerance", &MeasuredGradients::volume_tolerance, config::above(0),
                      "How far det F may be from 1. Within it, the stretch across the sheet is the one that keeps the "
                      "volume")
              .by_default());
}

Schema<Cycles> cycles_schema() {
  return Schema<Cycles>("cycles", "Which cycles of a test are kept.")
      .text("column", &Cycles::column,
            "Header of the numbers of the cycles; when left out, a cycle begins where the stretch has turned round "
            "from falling to rising")
      .integer("drop", &Cycles::drop, config::range(0, 1000), "So many first cycles are preconditioning")
      .by_default()
      .flag("last_only", &Cycles::last_only, "Is only the last cycle kept?")
      .by_default()
      .choice("branch", &Cycles::branch,
              {{"loading", Branch::loading}, {"unloading", Branch::unloading}, {"both", Branch::both}},
              "Which half of a cycle is kept")
      .by_default();
}

const config::Dimension& dimension_of(const FitTest& t) {
  return t.measure == MeasuredStress::force ? dimension::force : dimension::pressure;
}

void check_unit(const FitTest& t, Problems& problems) {
  const auto factor = config::parse_unit(t.unit, dimension_of(t));
  if (const auto* error = std::get_if<config::UnitError>(&factor)) problems.add("unit", error->what, error->remedy);
}

void check_columns(const FitTest& t, Problems& problems) {
  const bool gradients = std::holds_alternative<MeasuredGradients>(t.loading);
  if (gradients == t.load.has_value())
    problems.add("load", gradients ? "is given, but the columns F11 ... F33 are the deformation" : "is not given",
                 gradients ? "remove it" : "name the column of the deformation along the first axis");
  if (gradients && t.deformation != MeasuredDeformation::stretch)
    problems.add("deformation", "is given, but the columns F11 ... F33 are the deformation", "remove it");
  const auto* biaxial = std::get_if<BiaxialTest>(&t.loading);
  if (biaxial && t.load_across.has_value() == biaxial->load_ratio.has_value())
    problems.add("load_across",
                 t.load_across ? "and biaxial.load_ratio are both given" : "is not given, and neither is a load ratio",
                 "name the column of the second stretch, or give `biaxial: {load_ratio: 0.5}`");
  if (!biaxial && t.load_across)
    problems.add("load_across", "is given, but the test imposes one deformation only", "remove it");
  const bool one_stress =
      std::holds_alternative<PulledStrip>(t.loading) || std::holds_alternative<ShearTest>(t.loading);
  if (t.stress_across && one_stress)
    problems.add("stress_across", "is given, but the test has no second stress", "remove it");
  if (std::holds_alternative<ShearTest>(t.loading) && t.deformation != MeasuredDeformation::stretch)
    problems.add("deformation", "is given, but the load of simple shear is the amount of shear", "remove it");
  const bool force = t.measure == MeasuredStress::force;
  if (force && !t.section)
    problems.add("section", "is not given, but the forces need one",
                 "give the area at rest, such as `section: 12 mm^2`");
  if (force && t.stress_across && !t.section_across)
    problems.add("section_across", "is not given, but the forces across need one",
                 "give the area at rest, such as `section_across: 12 mm^2`");
  if (!force && (t.section || t.section_across))
    problems.add("section", "is given, but the file holds stresses", "remove it, or say `measure: force`");
}

Schema<FitTest> fit_test_schema() {
  return Schema<FitTest>("test", "Measured points of one test: a table with a header line; lines with # are skipped.")
      .include(&FitTest::loading, fit_loading_schema())
      .file("file", &FitTest::file, "CSV file")
      .text("load", &FitTest::load,
            "Header of the deformation along the first axis, or of the amount of shear; of all but `gradients`")
      .text("load_across", &FitTest::load_across, "Header of the deformation along the second axis")
      .text("stress", &FitTest::stress, "Header of the stress or force along the first axis, or of the shear stress")
      .text("stress_across", &FitTest::stress_across, "Header of that along the second axis")
      .text("protocol", &FitTest::protocol, "Header of the numbers that tell protocols in this file apart")
      .choice("deformation", &FitTest::deformation,
              {{"stretch", MeasuredDeformation::stretch},
               {"engineering_strain", MeasuredDeformation::engineering_strain},
               {"green_lagrange_strain", MeasuredDeformation::green_lagrange_strain}},
              "What the columns of the deformation hold")
      .by_default()
      .choice("measure", &FitTest::measure,
              {{"cauchy", MeasuredStress::cauchy},
               {"first_piola_kirchhoff", MeasuredStress::first_piola_kirchhoff},
               {"second_piola_kirchhoff", MeasuredStress::second_piola_kirchhoff},
               {"force", MeasuredStress::force}},
              "What the columns of the stress hold: force per present area, per area at rest, S, or the force itself")
      .text("unit", &FitTest::unit, "Unit of the stresses or forces in the file")
      .quantity("section", &FitTest::section, dimension::area, config::above(0),
                "Area at rest that the force along the first axis acts on")
      .quantity("section_across", &FitTest::section_across, dimension::area, config::above(0),
                "Area at rest that the force along the second axis acts on")
      .number("weight", &FitTest::weight, config::above(0), "Weight of the squared residuals of this test")
      .by_default()
      .section("cycles", &FitTest::cycles, cycles_schema(), "Preconditioning; all rows are kept when left out")
      .check(check_unit)
      .check(check_columns);
}

Schema<FitSpecimen> specimen_schema() {
  return Schema<FitSpecimen>("specimen", "A piece of tissue.")
      .map("tests", &FitSpecimen::tests, fit_test_schema(), "Its tests by name")
      .check([](const FitSpecimen& s, Problems& problems) {
        if (s.tests.empty()) problems.add("tests", "is empty", "add what was measured");
        check_keys("tests", s.tests, "test", problems);
      });
}

// --- laws ---------------------------------------------------------------------------------------------------------

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

Schema<FittedLaw> law_section_schema() {
  return Schema<FittedLaw>("fitted_law", "A law with values to be found.")
      .text("standard", &FittedLaw::standard,
            "A law as it is usually fitted to arteries: " + joined(fitting::standard_laws()))
      .section("material", &FittedLaw::material, wall::law_schema(),
               "The section `material` of a case, with `$name` or `-$name` in place of the values to be found")
      .map("parameters", &FittedLaw::parameters, fitting::parameter_schema(), "The values to be found, by name")
      .by_default()
      .shorthand("standard")
      .check([](const FittedLaw& law, Problems& problems) {
        if (law.standard.has_value() == law.material.has_value())
          problems.add("", law.standard ? "has both `standard` and `material`" : "has no law",
                       "give `material` and `parameters`, or one of: " + joined(fitting::standard_laws()));
      });
}

void check_fit_case(const FitCase& c, Problems& problems) {
  if (c.specimens.empty()) problems.add("specimens", "is empty", "add what was measured");
  if (c.laws.empty()) problems.add("laws", "is empty", "add one, such as `laws: {dfd: dfd}`");
  check_keys("specimens", c.specimens, "specimen", problems);
  check_keys("laws", c.laws, "law", problems);
  const auto factor = config::parse_unit(c.output.stress, dimension::pressure);
  if (const auto* error = std::get_if<config::UnitError>(&factor))
    problems.add("output.stress", error->what, error->remedy);
}

/// The section of a law as it is to be fitted: what the file says, or the standard that it names.
config::Document law_document(const config::Document& given, const std::string& where) {
  std::string standard = given.node().IsScalar() ? given.node().Scalar() : given.text("standard");
  if (standard.empty()) return given;
  const std::string text = fitting::standard_law(standard);
  if (text.empty())
    throw InputError(where, fmt::format("`{}` is no standard law", standard),
                     "choose from: " + joined(fitting::standard_laws()));
  return config::Document(text, where);
}

}  // namespace

double FitTest::factor() const { return config::unit_factor(unit, dimension_of(*this)); }

Schema<FitCase> FitCase::schema() {
  return Schema<FitCase>(
             "tunica fit",
             "The file of `tunica fit` is YAML: what was measured on specimens of a wall, and the laws that "
             "are fitted to it. Directions refer to the fibre frame: e1 circumferential, e2 longitudinal, "
             "e3 radial.")
      .text("title", &FitCase::title, "Free text for the report")
      .by_default()
      .map("specimens", &FitCase::specimens, specimen_schema(), "Specimens by name")
      .map("laws", &FitCase::laws, law_section_schema(), "Laws by name; several are ranked")
      .flag("incompressible", &FitCase::incompressible,
            "true: the volume is kept whatever the bulk modulus. When left out, the bulk modulus decides")
      .include(&FitCase::volumetric_energy, wall::volumetric_energy_schema())
      .section(
          "fit", &FitCase::fit,
          Schema<FitSettings>("fit", "How the fit is done.")
              .integer("starts", &FitSettings::starts, config::range(1, 1000),
                       "Starts: the given one and others spread between the bounds")
              .by_default()
              .integer("replicates", &FitSettings::replicates, config::range(40, 100000), "Replicates of the bootstrap")
              .by_default()
              .integer("seed", &FitSettings::seed, config::range(0, 1000000), "Of the bootstrap")
              .by_default(),
          "How the fit is done")
      .by_default()
      .section("in_vivo", &FitCase::in_vivo,
               Schema<InVivoStress>("in_vivo", "Cauchy stress of the wall in the body.")
                   .quantity("circumferential", &InVivoStress::circumferential, dimension::pressure,
                             config::range(0, 1e7), "Along e1: about pressure times radius over thickness")
                   .by_default("80 kPa")
                   .quantity("longitudinal", &InVivoStress::longitudinal, dimension::pressure, config::range(0, 1e7),
                             "Along e2")
                   .by_default("40 kPa"),
               "Where moduli are given, and up to where the law has to be convex and tested")
      .by_default()
      .section("output", &FitCase::output,
               Schema<FitOutput>("output", "Where and in which unit results are written.")
                   .path("directory", &FitOutput::directory, "Folder of the results, relative to that of the file")
                   .by_default("results")
                   .text("stress", &FitOutput::stress, "Unit of stresses")
                   .by_default(),
               "Results")
      .by_default()
      .check(check_fit_case);
}

ReadFitCase read_fit_case(const std::filesystem::path& file) {
  config::Document document(config::read_text(file), file.string());
  std::vector<Problem> problems;
  std::vector<fitting::LawTemplate> laws;
  const config::Document sections = document.part("laws");
  if (sections.node().IsMap())
    for (const auto& pair : sections.node()) {
      const std::string name = pair.first.Scalar(), where = "laws." + name;
      const config::Document given = document.part(where);
      try {
        const config::Document law = law_document(given, where);
        if (!law.has("material")) continue;  // the schema tells
        laws.push_back(fitting::read_law(law, where));
        if (given.has("material")) document.set(where + ".material", laws.back().started());
      } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      }
    }
  if (!problems.empty()) throw InputError(std::move(problems));
  auto parsed =
      config::parse_document(FitCase::schema(), document, {.name = file.string(), .folder = file.parent_path()});
  return {std::move(parsed.value), std::move(laws), std::move(parsed.warnings)};
}

std::shared_ptr<const config::Description> fit_description() { return FitCase::schema().description(); }

}  // namespace tunica::case_file
