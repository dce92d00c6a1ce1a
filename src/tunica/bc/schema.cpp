// The case-file keys of all boundary conditions.
#include "tunica/config/schema.hpp"

#include <fmt/format.h>

#include "tunica/base/error.hpp"
#include "tunica/bc/conditions.hpp"
#include "tunica/bc/formula.hpp"

namespace tunica::bc {

namespace dimension = config::dimension;
using config::above;
using config::anything;
using config::at_least;
using config::emplace;
using config::Problems;
using config::Schema;

namespace {

/// The usual values of a constant and of a step.
template <class Owner>
void expect_usual(Schema<Owner>& schema, const config::Dimension& due) {
  if (due == dimension::pressure) schema.plausible("-400 mmHg", "400 mmHg");
  if (due == dimension::volume_flow) schema.plausible("-60 L/min", "60 L/min");
}

Schema<Step> step_schema(const config::Dimension& due) {
  Schema<Step> schema("step", "Constant between two times, zero before and after.");
  schema.quantity("value", &Step::value, due, anything(), "Value while it lasts");
  expect_usual(schema, due);
  return schema.quantity("start", &Step::start, dimension::time, at_least(0), "Zero up to and at this time")
      .by_default()
      .quantity("end", &Step::end, dimension::time, above(0), "Zero after this time; for ever when left out")
      .check([](const Step& step, Problems& problems) {
        if (step.end && *step.end <= step.start)
          problems.add("end", "the step ends before it starts", "give an `end` after `start`, or leave it out");
      });
}

void check_table(const TableSource& table, Problems& problems) {
  const auto& options = table.options;
  if (!options.periodic && options.period)
    problems.add("period", "a period is given with `periodic: false`", "remove one of them");
  if (options.periodic && options.hold)
    problems.add("hold", "the last value is to hold after a periodic table", "set `periodic: false` or remove `hold`");
  if (options.hold && options.interpolation == Interpolation::ramp)
    problems.add("hold", "is given beside `interpolation: ramp`, which holds both ends", "remove one of them");
  const bool series = options.interpolation == Interpolation::fourier ||
                      (options.interpolation == Interpolation::automatic && is_simvascular(table.file));
  if (!options.periodic && options.interpolation == Interpolation::fourier)
    problems.add("interpolation", "a Fourier series needs a periodic table", "set `periodic: true` or use spline");
  if (table.file.format == TableFormat::fourier &&
      (options.interpolation != Interpolation::automatic || options.period || options.modes > 0 || options.trend))
    problems.add("format", "is fourier, whose file says all about interpolation, period, modes and trend",
                 "remove these keys");
  if (options.trend && !series)
    problems.add("trend", "belongs to a Fourier series", "set `interpolation: fourier` or remove `trend`");
  if (options.trend && options.period)
    problems.add("period", "is given beside `trend`, for which the table is one period", "remove one of them");
  if (options.modes > 0 && !series)
    problems.add("modes", "modes belong to a Fourier series", "set `interpolation: fourier` or remove `modes`");
}

Schema<TableSource> table_schema(const config::Dimension& due) {
  Schema<TableSource> schema("table", "Time course from a file.");
  schema
      .file(
          "file", [](TableSource & t) -> auto& { return t.file.path; },
          "CSV with a header line, or a SimVascular .flow file")
      .choice(
          "format", [](TableSource & t) -> auto& { return t.file.format; },
          {{"automatic", TableFormat::automatic},
           {"csv", TableFormat::csv},
           {"simvascular", TableFormat::simvascular},
           {"fourier", TableFormat::fourier}},
          "Automatic: by the extension, .csv, .flow, or .fcs for the coefficients of a Fourier series")
      .by_default()
      .text(
          "time_column", [](TableSource & t) -> auto& { return t.file.time_column; },
          "CSV: name of the time column; the first one when left out")
      .optional()
      .text(
          "value_column", [](TableSource & t) -> auto& { return t.file.value_column; },
          "CSV: name of the value column; may be left out when there are two columns")
      .optional()
      .unit(
          "time_unit", [](TableSource & t) -> auto& { return t.file.time_unit; }, dimension::time,
          "Unit of the time column; for a phase from 0 to 1 the period, such as `0.9 s`");
  if (due == dimension::none)
    schema
        .number(
            "unit", [](TableSource & t) -> auto& { return t.file.value_unit; }, above(0), "Factor of the value column")
        .by_default();
  else
    schema.unit(
        "unit", [](TableSource & t) -> auto& { return t.file.value_unit; }, due,
        "Unit of the value column; for values relative to a reference that reference, such as `5 L/min`");
  schema
      .choice(
          "interpolation", [](TableSource & t) -> auto& { return t.options.interpolation; },
          {{"automatic", Interpolation::automatic},
           {"linear", Interpolation::linear},
           {"spline", Interpolation::spline},
           {"fourier", Interpolation::fourier},
           {"ramp", Interpolation::ramp}},
          "Automatic: fourier for periodic .flow tables, as their readers do, else linear. Straight lines, cubic "
          "spline, the first modes of the Fourier series, or one straight line from the first "
          "value to the last, which hold before and after")
      .by_default()
      .flag(
          "periodic", [](TableSource & t) -> auto& { return t.options.periodic; },
          "Repeat the table; if false, times outside it are an error, but see `hold`")
      .by_default()
      .flag(
          "hold", [](TableSource & t) -> auto& { return t.options.hold; },
          "With `periodic: false`: the last value holds after the end of the table")
      .by_default()
      .quantity(
          "period", [](TableSource & t) -> auto& { return t.options.period; }, dimension::time, above(0),
          "Period, when the table stops before its end; by default the table spans one period and closes")
      .integer(
          "modes", [](TableSource & t) -> auto& { return t.options.modes; }, at_least(1),
          "Fourier modes, the mean included; when left out those named in a .flow file")
      .optional()
      .flag(
          "trend", [](TableSource & t) -> auto& { return t.options.trend; },
          "Fourier: the straight line from the first to the last value is taken off first and added in every period, "
          "so that the table need not close; automatic for .flow tables without `period`")
      .by_default()
      .check(check_table);
  return schema;
}

using Source = std::variant<double, Step, TableSource>;

Schema<Source> source_schema(const config::Dimension& due) {
  Schema<Source> schema("source", "Constant, step or table.");
  schema.one_of().quantity("value", emplace<double>, due, anything(), "Constant value");
  expect_usual(schema, due);
  return schema.section("step", emplace<Step>, step_schema(due), "Constant between two times, zero before and after")
      .section("table", emplace<TableSource>, table_schema(due), "Time course from a file");
}

/// Axes along which something is given, at least one.
template <class C>
Schema<C>& add_directions(Schema<C>& schema, const char* meaning, const char* without) {
  return schema.any_of("directions", &C::directions, {"x", "y", "z"}, meaning)
      .by_default()
      .check([without](const C& c, Problems& problems) {
        if (c.directions == Axes{})
          problems.add("directions", "names no axis",
                       fmt::format("name at least one, or use the condition `{}`", without));
      });
}

/// A value along an axis that is free would have no effect.
template <class C>
void check_free_axes(const C& c, const Vec3<double>& value, const char* what, Problems& problems) {
  for (int i = 0; i < 3; ++i)
    if (!c.directions[static_cast<std::size_t>(i)] && value[i] != 0)
      problems.add("value", fmt::format("{} along {}, which `directions` leaves free", what, "xyz"[i]),
                   "give 0 there, or name the axis in `directions`");
}

/// Keys of a time course: value | step | table, scale, ramp_time.
Schema<WaveformInput> waveform_schema(const config::Dimension& due) {
  return Schema<WaveformInput>("waveform", "Time course of a boundary value.")
      .include(&WaveformInput::source, source_schema(due))
      .number("scale", &WaveformInput::scale, anything(), "Factor on the whole course")
      .by_default()
      .quantity("ramp_time", &WaveformInput::ramp_time, dimension::time, at_least(0),
                "Start-up: the course is multiplied by (1 - cos(pi t / ramp_time)) / 2 until then")
      .by_default();
}

Schema<SupportValue> support_value_schema(const config::Dimension& due, const config::Range& allowed, const char* low,
                                          const char* high) {
  Schema<FaceArray> array("array", "Values at the nodes of the face.");
  array.text("name", &FaceArray::name, "Point array in the mesh file of the face")
      .unit("unit", &FaceArray::unit, due, "Its unit")
      .file("file", &FaceArray::file,
            ".vtp with the points of the face, where the array does not stand in its own file");
  return Schema<SupportValue>("support_value", "One value for the face, or an array of its mesh file.")
      .one_of()
      .quantity("value", config::emplace<double>, due, allowed, "The same on the whole face")
      .plausible(low, high)
      .alternative(array)
      .shorthand("value");
}

Schema<OverFace> over_face_schema(const config::Dimension& due, const char* columns, const char* unit) {
  Schema<OverFace> schema("over_face", "Values at points of the face.");
  schema
      .file("table", &OverFace::table,
            fmt::format("CSV file with the columns x, y, z, {}, a line for each point; with a column t (in s) as many "
                        "times, between which the values are linear, each with the same points in the same order",
                        columns))
      .quantity("period", &OverFace::period, dimension::time, above(0),
                "Of a table with a column t: it repeats itself; when left out its first and last values hold");
  if (due == dimension::none)
    schema.number("unit", &OverFace::unit, above(0), unit).by_default();
  else
    schema.unit("unit", &OverFace::unit, due, unit);
  return schema.unit("length_unit", &OverFace::length_unit, dimension::length, "Unit of x, y and z")
      .choice("interpolation", &OverFace::interpolation,
              {{"nearest", OverFace::Interpolation::nearest}, {"linear", OverFace::Interpolation::linear}},
              "The nearest point, or a linear function fitted to the nearest ones, which weigh the more the closer "
              "they are")
      .by_default();
}

constexpr const char *velocity_directions =
                         "Axes along which the velocity is given; along the others the blood is free and no traction "
                         "acts",
                     *fixed_beside_load = "Of a wall face: axes along which it does not move, under the load",
                     *moves_as_a_whole =
                         "Of a wall face: it moves as a whole under the load and does not turn, like a "
                         "plate bonded to it";

}  // namespace

Schema<NoSlip> NoSlip::schema() { return Schema<NoSlip>("no_slip", "Blood at rest at a rigid wall."); }

Schema<Velocity> Velocity::schema() {
  Schema<Velocity> schema("velocity", "The same velocity at all nodes of the face.");
  schema.quantities("value", &Velocity::value, dimension::velocity, anything(), "Velocity vector x, y, z")
      .plausible("-10 m/s", "10 m/s")
      .section("waveform", &Velocity::course, waveform_schema(dimension::none),
               "Factor over time; constant when left out")
      .optional();
  return add_directions(schema, velocity_directions, "pressure").check([](const Velocity& c, Problems& problems) {
    check_free_axes(c, c.value, "is a velocity", problems);
  });
}

Schema<Flow> Flow::schema() {
  return Schema<Flow>("flow", "Flow rate through an opening, with a velocity profile that vanishes on its rim.")
      .include(&Flow::course, waveform_schema(dimension::volume_flow))
      .choice("positive", &Flow::positive,
              {{"automatic", Sign::automatic}, {"inflow", Sign::inflow}, {"outflow", Sign::outflow}},
              "What a positive number means; automatic: inflow, but outflow in SimVascular tables")
      .by_default()
      .choice("profile", &Flow::profile, {{"parabolic", Profile::parabolic}, {"flat", Profile::flat}},
              "Parabolic: fully developed, for an opening of any shape; flat: constant up to the rim")
      .by_default()
      .shorthand("value");
}

Schema<Traction> Traction::schema() {
  Schema<Traction> size("traction_size", "The same on the whole face, or at points of it.");
  size.one_of()
      .quantities("value", &Traction::vector, dimension::pressure, anything(), "Traction vector x, y, z")
      .plausible("-400 mmHg", "400 mmHg")
      .section("over_face", &Traction::over_face,
               over_face_schema(dimension::pressure, "tx, ty, tz", "Unit of the traction"), "Tractions at points");
  return Schema<Traction>("traction", "Force per area with a fixed direction.")
      .include(
          [](Traction & t) -> auto& { return t; }, size)
      .section("waveform", &Traction::course, waveform_schema(dimension::none),
               "Factor over time; constant when left out")
      .optional()
      .any_of("fixed", &Traction::fixed, {"x", "y", "z"}, fixed_beside_load)
      .by_default()
      .flag("undeforming", &Traction::undeforming, moves_as_a_whole)
      .by_default();
}

Schema<Pressure> Pressure::schema() {
  return Schema<Pressure>("pressure", "Pressure on the face, against its outward normal.")
      .include(&Pressure::pressure, waveform_schema(dimension::pressure))
      .flag("follower", &Pressure::follower,
            "On a wall face: true follows the deformed face, false keeps the reference normal and area")
      .by_default()
      .any_of("fixed", &Pressure::fixed, {"x", "y", "z"}, fixed_beside_load)
      .by_default()
      .flag("undeforming", &Pressure::undeforming, moves_as_a_whole)
      .by_default()
      .section("over_face", &Pressure::over_face, over_face_schema(dimension::none, "factor", "Factor of the factors"),
               "What the pressure is multiplied by at points of the face")
      .shorthand("value");
}

Schema<Resistance> Resistance::schema() {
  return Schema<Resistance>("resistance", "Outlet whose pressure grows with the flow: P = R Q + P_d.")
      .quantity("resistance", &Resistance::resistance, dimension::resistance, at_least(0), "R")
      .plausible("1e5 Pa s/m^3", "1e12 Pa s/m^3")
      .quantity("distal_pressure", &Resistance::distal_pressure, dimension::pressure, anything(), "P_d")
      .by_default()
      .plausible("-20 mmHg", "200 mmHg")
      .shorthand("resistance");
}

Schema<Rcr> Rcr::schema() {
  return Schema<Rcr>("rcr", "Three-element Windkessel: P = P_c + R_p Q, C dP_c/dt = Q - (P_c - P_d) / R_d.")
      .quantity("proximal", &Rcr::proximal, dimension::resistance, at_least(0), "R_p")
      .plausible("0 Pa s/m^3", "1e12 Pa s/m^3")
      .quantity("capacitance", &Rcr::capacitance, dimension::compliance, above(0), "C")
      .plausible("1e-13 m^3/Pa", "1e-7 m^3/Pa")
      .quantity("distal", &Rcr::distal, dimension::resistance, above(0), "R_d")
      .plausible("1e5 Pa s/m^3", "1e12 Pa s/m^3")
      .quantity("distal_pressure", &Rcr::distal_pressure, dimension::pressure, anything(), "P_d")
      .by_default()
      .plausible("-20 mmHg", "200 mmHg")
      .quantity("initial_pressure", &Rcr::initial_pressure, dimension::pressure, anything(),
                "P_c at the start, which is the outlet's pressure at no flow; P_d when left out")
      .plausible("-20 mmHg", "300 mmHg");
}

Schema<Fixed> Fixed::schema() {
  return Schema<Fixed>("fixed", "No displacement, in all or some directions.")
      .any_of("directions", &Fixed::directions, {"x", "y", "z", "normal", "all"},
              "Axes, or `normal` (mean normal of the face), or `all`")
      .by_default()
      .shorthand("directions")
      .check([](const Fixed& fixed, Problems& problems) {
        int listed = 0;
        for (const bool direction : fixed.directions) listed += direction;
        if (listed == 0)
          problems.add("directions", "no direction is fixed", "list at least one, or use the condition `free`");
        if (listed > 1 && (fixed.directions[all] || fixed.directions[normal]))
          problems.add("directions", "`all` and `normal` cannot be mixed with other directions",
                       "give `all`, `normal`, or some of x, y, z");
      });
}

Schema<Displacement> Displacement::schema() {
  Schema<Displacement> size("displacement_size", "The same on the whole face, or at points of it.");
  size.one_of()
      .quantities("value", &Displacement::value, dimension::length, anything(), "Displacement vector x, y, z")
      .section("over_face", &Displacement::over_face,
               over_face_schema(dimension::length, "ux, uy, uz", "Unit of the displacement"),
               "Displacements at points");
  Schema<Displacement> schema("displacement", "A wall face that is moved: displacement over time.");
  schema
      .include(
          [](Displacement & d) -> auto& { return d; }, size)
      .section("waveform", &Displacement::course, waveform_schema(dimension::none),
               "Factor over time; constant when left out")
      .optional();
  return add_directions(schema, "Axes along which the face is moved; it is free along the others", "free")
      .check(
          [](const Displacement& c, Problems& problems) { check_free_axes(c, c.value, "moves the face", problems); });
}

Schema<Free> Free::schema() { return Schema<Free>("free", "No traction on the face."); }

Schema<Support> Support::schema() {
  return Schema<Support>("support", "Elastic surrounding tissue: traction -k_s u - c_s du/dt - p_0 n.")
      .section("stiffness", &Support::stiffness,
               support_value_schema(dimension::stiffness_per_area, at_least(0), "1e3 N/m^3", "1e12 N/m^3"), "k_s")
      .section("damping", &Support::damping,
               support_value_schema(dimension::damping_per_area, at_least(0), "0 N s/m^3", "1e12 N s/m^3"), "c_s")
      .by_default("0 N s/m^3")
      .section("pressure", &Support::pressure,
               support_value_schema(dimension::pressure, anything(), "-100 mmHg", "100 mmHg"),
               "p_0 of the surroundings")
      .by_default("0 Pa")
      .choice("direction", &Support::direction, {{"full", Direction::full}, {"normal", Direction::normal}},
              "Act on the whole displacement or on its normal part only")
      .by_default();
}

Schema<Symmetry> Symmetry::schema() {
  return Schema<Symmetry>(
      "symmetry",
      "Plane of symmetry: nothing moves across the face, which has to be flat, and no traction acts "
      "along it.");
}

namespace {

void check_profile(const VelocityProfile& profile, Problems& problems) {
  const int given = !profile.velocity.empty() + profile.speed.has_value() + profile.table.has_value();
  if (given != 1)
    problems.add("", given == 0 ? "says no velocity" : "says the velocity in more than one way",
                 "give `velocity` (three formulas), `speed` (one formula) or `table` (a file)");
  if (!profile.velocity.empty() && profile.velocity.size() != 3)
    problems.add("velocity", fmt::format("has {} formulas", profile.velocity.size()),
                 "give three: the components x, y, z, such as [\"4*y*(1-y)\", \"0\", \"0\"]");
  if (profile.period && !profile.table)
    problems.add("period", "belongs to a `table` with a column t", "remove it, formulas know the time as t");
  const auto check_formula = [&](const char* key, const std::string& text) {
    try {
      const Formula formula(text);
    } catch (const InputError& error) {
      for (const auto& p : error.problems()) problems.add(key, p.what, p.remedy);
    }
  };
  if (profile.speed && profile.directions != Axes{true, true, true})
    problems.add("directions", "are given beside `speed`, which is along the normal of the face",
                 "give `velocity`, three formulas, in its place");
  for (const auto& text : profile.velocity) check_formula("velocity", text);
  if (profile.speed) check_formula("speed", *profile.speed);
}

}  // namespace

Schema<VelocityProfile> VelocityProfile::schema() {
  Schema<VelocityProfile> schema("profile",
                                 "Velocity as a function of place and time, by formulas of x, y, z (in `length_unit`) "
                                 "and t (in s), or by a table of points.");
  schema.texts("velocity", &VelocityProfile::velocity, "Formulas of the components x, y, z of the velocity")
      .by_default()
      .text("speed", &VelocityProfile::speed, "Formula of the speed into the domain, along the mean normal of the face")
      .file(
          "table", &VelocityProfile::table,
          "CSV file with the columns x, y, z, vx, vy, vz, a line for each point; with a column t (in s) as many times, "
          "between which the velocities are linear, each with the same points in the same order")
      .quantity("period", &VelocityProfile::period, dimension::time, above(0),
                "Of a table with a column t: it repeats itself; when left out its first and last values hold")
      .unit("unit", &VelocityProfile::unit, dimension::velocity, "Unit of the velocity")
      .unit("length_unit", &VelocityProfile::length_unit, dimension::length, "Unit of x, y and z")
      .choice("interpolation", &VelocityProfile::interpolation,
              {{"nearest", Interpolation::nearest}, {"linear", Interpolation::linear}},
              "Of the table: the nearest point, or a linear function fitted to the nearest ones, which weigh the more "
              "the closer they are")
      .by_default()
      .section("waveform", &VelocityProfile::course, waveform_schema(dimension::none),
               "Factor over time; constant when left out")
      .optional()
      .check(check_profile);
  return add_directions(schema, velocity_directions, "pressure");
}

Schema<Condition> condition_schema() {
  return Schema<Condition>("condition", "What happens at a face of the mesh.")
      .one_of()
      .alternative(NoSlip::schema())
      .alternative(Velocity::schema())
      .alternative(Flow::schema())
      .alternative(Pressure::schema())
      .alternative(Traction::schema())
      .alternative(Resistance::schema())
      .alternative(Rcr::schema())
      .alternative(Fixed::schema())
      .alternative(Free::schema())
      .alternative(Support::schema())
      .alternative(Symmetry::schema())
      .alternative(VelocityProfile::schema())
      .alternative(Displacement::schema());
}

}  // namespace tunica::bc
