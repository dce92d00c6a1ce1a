#include "tunica/case/material_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tunica/case/descriptions.hpp"
#include "tunica/case/keys.hpp"

namespace tunica::case_file {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

namespace {

// --- loading ------------------------------------------------------------------------------------------------------

/// Of stretches, which begin at 1, or of shear, which begins at 0.
Schema<LoadPath> path_schema(bool shear) {
  const config::Range allowed = shear ? config::range(-20, 20) : config::range(0.05, 20);
  const std::string what = shear ? "Amount of shear" : "Stretch";
  return Schema<LoadPath>("path", "Values of the load.")
      .number("from", &LoadPath::from, allowed, what + " of the first line; it is reached from rest")
      .by_default(shear ? "0" : "1")
      .number("to", &LoadPath::to, allowed, what + " of the last line")
      .integer("steps", &LoadPath::steps, config::range(1, 100000), "Equal steps between them")
      .by_default()
      .check([](const LoadPath& p, Problems& problems) {
        if (p.from == p.to) problems.add("to", "is where the path begins", "give two values");
      });
}

Schema<Uniaxial> uniaxial_schema() {
  return Schema<Uniaxial>("uniaxial", "Stretched along one axis; the other two faces bear no traction.")
      .section("along", &Uniaxial::along, direction_schema(), "Loading axis")
      .by_default("e1")
      .include(&Uniaxial::stretch, path_schema(false));
}

template <class T>
Schema<T> sheet_schema(const char* name, const char* help, const char* along, const char* across) {
  return sheet_axes_schema<T>(name, help, along, across)
      .include(&Sheet::load, path_schema(std::is_same_v<T, SimpleShear>));
}

Schema<Biaxial> biaxial_schema() {
  return sheet_schema<Biaxial>("biaxial",
                               "Stretched along two axes by different amounts, without shear between them; the third "
                               "face bears no traction.",
                               "First axis, that of `from` and `to`", "Second axis")
      .number("to_across", &Biaxial::to_across, config::range(0.05, 20),
              "Stretch of the second axis when the first is at `to`; straight there from 1. Or give `ratio`")
      .number("ratio", &Biaxial::ratio, config::range(-10, 10),
              "(stretch of the second axis - 1) / (stretch of the first - 1)")
      .check([](const Biaxial& b, Problems& problems) {
        if (b.to_across.has_value() == b.ratio.has_value())
          problems.add("", b.ratio ? "`to_across` and `ratio` are both given" : "the second stretch is not given",
                       "give one of `to_across` and `ratio`");
        else if (b.to_across && b.load.to == 1.0)
          problems.add("to_across", "has no path when `to` is 1", "stretch the first axis, too, or use `planar`");
        else if (!(std::min(b.across_at(b.load.from), b.across_at(b.load.to)) > 0.05))
          problems.add("", "the second stretch becomes smaller than 0.05", "choose another ratio");
      });
}

Schema<Gradient> gradient_schema() {
  return Schema<Gradient>("gradient", "A deformation gradient.")
      .quantities("F", &Gradient::F, dimension::none, config::anything(),
                  "F11, F12, F13, F21 ... F33 in the fibre frame")
      .shorthand("F")
      .check([](const Gradient& g, Problems& problems) {
        Mat3<double> F{};
        std::copy(g.F.begin(), g.F.end(), &F(0, 0));
        if (!(determinant(F) > 0.0))
          problems.add("F", fmt::format("has the determinant {:.4g}", determinant(F)), "det F is above zero");
      });
}

Schema<Gradients> gradients_schema() {
  return Schema<Gradients>("gradients", "Given deformation gradients; no equilibrium is solved.")
      .list("list", &Gradients::list, gradient_schema(), "`[[1.1, 0, 0, 0, 1, 0, 0, 0, 0.91], ...]`; or `file`")
      .by_default()
      .file("file", &Gradients::file, "CSV with columns F11, F12, F13, F21 ... F33; other columns are left aside")
      .check([](const Gradients& g, Problems& problems) {
        if (g.file.has_value() != g.list.empty())
          problems.add("", g.file ? "`file` and `list` are both given" : "no deformation gradient is given",
                       "give one of `list` and `file`");
      });
}

// --- tests --------------------------------------------------------------------------------------------------------

Schema<Loading> material_loading_schema() {
  return Schema<Loading>("loading", "How the specimen is loaded.")
      .one_of()
      .alternative(uniaxial_schema())
      .alternative(sheet_schema<Equibiaxial>("equibiaxial",
                                             "Stretched equally along two axes; the third face bears no traction.",
                                             "First axis", "Second axis"))
      .alternative(biaxial_schema())
      .alternative(sheet_schema<Planar>(
          "planar",
          "Planar tension, also called pure shear: stretched along one axis at constant width; the third face bears no "
          "traction.",
          "Stretched axis", "Axis along which the width is held"))
      .alternative(sheet_schema<SimpleShear>("simple_shear",
                                             "F = I + shear a1 (x) a2, wholly prescribed. Of an incompressible law the "
                                             "pressure is that at which the third face bears no normal traction.",
                                             "Direction a1 of the shear", "Normal a2 of the planes that slide"))
      .alternative(gradients_schema());
}

Schema<MeasuredData> data_schema() {
  return Schema<MeasuredData>("data", "Measured points that are drawn over the curve and compared with it.")
      .file("file", &MeasuredData::file, "CSV with a header line; lines that begin with # are skipped")
      .text("load", &MeasuredData::load, "Header of the stretch or shear")
      .text("stress", &MeasuredData::stress, "Header of the stress along the loading axis, or the shear stress")
      .text("stress_across", &MeasuredData::stress_across, "Header of the stress along the second axis, if measured")
      .unit("unit", &MeasuredData::unit, dimension::pressure, "Unit of the stresses in the file");
}

void check_test(const MaterialTest& t, Problems& problems) {
  if (!t.data) return;
  if (std::holds_alternative<Gradients>(t.loading))
    problems.add("data", "is given, but deformation gradients have no axis to compare along", "remove it");
  if (t.data->stress_across &&
      (std::holds_alternative<Uniaxial>(t.loading) || std::holds_alternative<SimpleShear>(t.loading)))
    problems.add("data.stress_across", "is given, but the test has no second stress", "remove it");
}

Schema<MaterialTest> material_test_schema() {
  return Schema<MaterialTest>("test", "One test of a specimen.")
      .include(&MaterialTest::loading, material_loading_schema())
      .choice("measure", &MaterialTest::measure,
              {{"cauchy", StressMeasure::cauchy},
               {"first_piola_kirchhoff", StressMeasure::first_piola_kirchhoff},
               {"second_piola_kirchhoff", StressMeasure::second_piola_kirchhoff}},
              "Stress that is drawn, and that the measured data hold: per present area, per area at rest, or S")
      .by_default()
      .section("data", &MaterialTest::data, data_schema(), "Measured points; none when left out")
      .check(check_test);
}

Schema<MaterialOutput> output_schema() {
  return Schema<MaterialOutput>("output", "Where and in which unit results are written.")
      .path("directory", &MaterialOutput::directory, "Folder of the results, relative to that of the file")
      .by_default("results")
      .text("stress", &MaterialOutput::stress, "Unit of stresses, tangents and energy densities")
      .by_default()
      .choice("plots", &MaterialOutput::plots, {{"svg", PlotFormat::svg}, {"png", PlotFormat::png}},
              "Format of the plots")
      .by_default()
      .check([](const MaterialOutput& o, Problems& problems) {
        const auto factor = config::parse_unit(o.stress, dimension::pressure);
        if (const auto* error = std::get_if<config::UnitError>(&factor))
          problems.add("stress", error->what, error->remedy);
      });
}

void check_material_case(const MaterialCase& c, Problems& problems) {
  if (c.incompressible == false && !std::isfinite(bulk_modulus(c.material)))
    problems.add("incompressible", "is false, but the law has no finite bulk modulus",
                 "give the law a bulk_modulus, or a poisson_ratio below 0.5");
  if (c.tests.empty()) problems.add("tests", "is empty", "add one, such as `pull: {uniaxial: {to: 1.2}}`");
  check_keys("tests", c.tests, "test", problems);
}

}  // namespace

Schema<Direction> direction_schema() {
  return Schema<Direction>("direction",
                           "A direction in the fibre frame: `e1`, `{angle: 30 deg}`, `{vector: [1, 0, 1]}`.")
      .one_of()
      .alternative(Schema<Axis<0>>("e1", "Circumferential."))
      .alternative(Schema<Axis<1>>("e2", "Longitudinal."))
      .alternative(Schema<Axis<2>>("e3", "Radial."))
      .quantity("angle", config::emplace<double>, config::dimension::angle,
                config::range(-3.1415926535898, 3.1415926535898), "In the plane of e1 and e2, from e1 towards e2")
      .quantities("vector", config::emplace<Vec3<double>>, dimension::none, config::anything(),
                  "Components along e1, e2, e3, of any length but 0")
      .check([](const Direction& d, Problems& problems) {
        if (!(norm(vector_of(d)) > 0.0))
          problems.add("vector", "has length zero", "give a direction, such as [1, 0, 1]");
      });
}

void check_perpendicular(const SheetAxes& axes, Problems& problems) {
  const Vec3<double> a = vector_of(axes.along), b = vector_of(axes.across);
  if (!(std::abs(dot(a, b)) <= 1e-3 * norm(a) * norm(b)))
    problems.add("across", "is not perpendicular to `along`", "give two perpendicular directions");
}

Vec3<double> vector_of(const Direction& direction) {
  if (const auto* v = std::get_if<Vec3<double>>(&direction)) return *v;
  if (const auto* angle = std::get_if<double>(&direction)) return {{std::cos(*angle), std::sin(*angle), 0.0}};
  Vec3<double> axis{};
  axis[static_cast<int>(direction.index())] = 1.0;
  return axis;
}

double Biaxial::across_at(double stretch) const {
  const double slope = ratio ? *ratio : (*to_across - 1.0) / (load.to - 1.0);
  return 1.0 + slope * (stretch - 1.0);
}

wall::Volumetric MaterialCase::volumetric() const {
  if (incompressible == true) return {volumetric_energy};
  return {volumetric_energy, bulk_modulus(material)};
}

Schema<MaterialCase> MaterialCase::schema() {
  return Schema<MaterialCase>(
             "tunica material",
             "The file of `tunica material` is YAML: a wall law and the tests that a specimen of it is "
             "put through. Directions refer to the fibre frame: e1 circumferential, e2 longitudinal, "
             "e3 radial.")
      .text("title", &MaterialCase::title, "Free text for plots")
      .by_default()
      .section("material", &MaterialCase::material, wall::law_schema(), "Law and its parameters")
      .include(&MaterialCase::volumetric_energy, wall::volumetric_energy_schema())
      .flag("incompressible", &MaterialCase::incompressible,
            "true: the volume is kept whatever the bulk modulus. When left out, the bulk modulus decides")
      .map("tests", &MaterialCase::tests, material_test_schema(),
           "Tests by name; each writes a table `<name>.csv` and a plot `<name>.svg`")
      .section("output", &MaterialCase::output, output_schema(), "Results")
      .by_default()
      .check(check_material_case);
}

config::Parsed<MaterialCase> read_material_case(const std::filesystem::path& file) {
  return config::parse_file(MaterialCase::schema(), file);
}

std::shared_ptr<const config::Description> material_description() { return MaterialCase::schema().description(); }

}  // namespace tunica::case_file
