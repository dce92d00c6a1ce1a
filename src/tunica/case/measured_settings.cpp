#include "tunica/case/measured_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/config/document.hpp"
#include "tunica/files/csv_file.hpp"

namespace tunica::case_file {

namespace {

using config::Problems;
using config::Schema;
namespace dimension = config::dimension;

Schema<MeasuredCurve> curve_schema(const config::Dimension& due) {
  return Schema<MeasuredCurve>("curve", "A course in time from a table.")
      .file("file", &MeasuredCurve::file, "Table with a line of headers, such as flows.csv of `tunica measure`")
      .text("time_column", &MeasuredCurve::time_column, "Header of the times; the first column when left out")
      .optional()
      .text("value_column", &MeasuredCurve::value_column, "Header of the values")
      .text("uncertainty_column", &MeasuredCurve::uncertainty_column,
            "Header of one standard deviation of each value, in the unit of the values; `uncertainty` when left out")
      .optional()
      .unit("time_unit", &MeasuredCurve::time_unit, dimension::time, "Unit of the times")
      .unit("unit", &MeasuredCurve::value_unit, due, "Unit of the values")
      .quantity("shift", &MeasuredCurve::shift, dimension::time, config::anything(),
                "Added to the times, where the scanner's trigger is not the start of the computed beat")
      .by_default();
}

/// `places`: those of opening, point and plane at which the quantity can be computed.
Schema<Measurement> measurement_schema(const MeasurementKind& kind, const config::Dimension& due,
                                       const std::set<std::string>& places) {
  Schema<Measurement> schema("measurement", fmt::format("A measured {} at one place.", kind.quantity));
  if (places.contains("opening")) schema.text("opening", &Measurement::opening, "Face of the lumen");
  if (places.contains("point")) schema.text("point", &Measurement::point, "Name of one of `output.points`");
  if (places.contains("plane"))
    schema.section("plane", &Measurement::plane, MeasuredPlane::schema(), "Plane through the lumen");
  schema.quantity(kind.largest, &Measurement::largest, due, config::anything(), "Largest value over the beat")
      .quantity(kind.smallest, &Measurement::smallest, due, config::anything(), "Smallest value over the beat")
      .quantity("mean", &Measurement::mean, due, config::anything(), "Mean over the beat")
      .section("curve", &Measurement::curve, curve_schema(due), "The course over the beat, in place of single values")
      .quantity("uncertainty", &Measurement::uncertainty, due, config::above(0), "One standard deviation");
  return schema.check([kind, places](const Measurement& m, Problems& problems) {
    if (m.opening.has_value() + m.point.has_value() + m.plane.has_value() != 1)
      problems.add("", "names no place, or several", "give one of: " + files::listed({places.begin(), places.end()}));
    const bool values = m.largest || m.smallest || m.mean;
    if (values == m.curve.has_value())
      problems.add("", values ? "has single values and a curve" : "has no value",
                   fmt::format("give `curve`, or some of `{}`, `{}`, `mean`", kind.largest, kind.smallest));
    if (m.largest && m.smallest && *m.largest < *m.smallest)
      problems.add(kind.largest, fmt::format("lies below `{}`", kind.smallest), "exchange them");
    if (!m.uncertainty && !(m.curve && !m.curve->uncertainty_column.empty()))
      problems.add("uncertainty", "is missing: without it nothing can be said of a difference",
                   "give one standard deviation, of a cuff about 5 mmHg");
  });
}

void check_names(const MeasuredCase& measured, Problems& problems) {
  std::set<std::string> seen;
  for (const auto& kind : measurement_kinds())
    for (const auto& [name, entry] : measured.*kind.entries)
      if (!seen.insert(name).second)
        problems.add(fmt::format("{}.{}", kind.key, name), "has the name of another measurement", "rename one of them");
}

}  // namespace

Schema<MeasuredPlane> MeasuredPlane::schema() {
  return Schema<MeasuredPlane>("plane", "A plane through a lumen.")
      .quantities("centre", &MeasuredPlane::centre, dimension::length, config::anything(),
                  "In the lumen: the piece of it in the plane that is nearest counts")
      .quantities("normal", &MeasuredPlane::normal, dimension::none, config::anything(),
                  "Of any length; flow along it is positive")
      .check([](const MeasuredPlane& p, Problems& problems) {
        if (!(norm(p.normal) > 0)) problems.add("normal", "has no length", "write a direction, such as [0, 0, -1]");
      });
}

std::vector<Problem> check_measured(const MeasuredCase& measured, const std::vector<std::string>& points) {
  std::vector<Problem> problems;
  for (const auto& kind : measurement_kinds())
    for (const auto& [name, entry] : measured.*kind.entries) {
      const auto where = fmt::format("measured.{}.{}", kind.key, name);
      if (entry.point && std::find(points.begin(), points.end(), *entry.point) == points.end())
        problems.push_back({where + ".point", fmt::format("the case records no point '{}'", *entry.point),
                            points.empty() ? "add it to `output.points`" : "use one of: " + files::listed(points)});
      if (!entry.curve) continue;
      try {
        read_course(entry);
      } catch (const InputError& error) {
        for (const auto& p : error.problems()) problems.push_back({where + ".curve: " + p.where, p.what, p.remedy});
      }
    }
  return problems;
}

MeasuredCourse read_course(const Measurement& measurement) {
  const auto& c = measurement.curve.value();
  const auto table = files::read_csv(c.file, "give a table with a line of headers and columns of numbers");
  const auto scaled = [&](std::size_t column, double unit, double shift) {
    std::vector<double> values;
    for (const double v : table.columns[column]) values.push_back(unit * v + shift);
    return values;
  };
  MeasuredCourse course{.times = scaled(c.time_column.empty() ? 0 : table.find(c.time_column), c.time_unit, c.shift),
                        .values = scaled(table.find(c.value_column), c.value_unit, 0),
                        .deviations = {}};
  const std::string file = c.file.string();
  if (course.times.size() < 2) throw InputError(file, "has fewer than two lines of numbers", "give the whole course");
  for (std::size_t k = 1; k < course.times.size(); ++k)
    if (!(course.times[k] > course.times[k - 1]))
      throw InputError(file, fmt::format("has the time {:.6g} s behind {:.6g} s", course.times[k], course.times[k - 1]),
                       "order the lines by time");
  course.deviations = c.uncertainty_column.empty()
                          ? std::vector<double>(course.times.size(), measurement.uncertainty.value())
                          : scaled(table.find(c.uncertainty_column), c.value_unit, 0);
  for (const double d : course.deviations)
    if (!(d > 0))
      throw InputError(file, "has a standard deviation that is not above zero",
                       "give what is known of the uncertainty");
  return course;
}

const std::vector<MeasurementKind>& measurement_kinds() {
  static const std::vector<MeasurementKind> kinds = {
      {"pressures", "pressure", "mmHg", "systolic", "diastolic", 133.322387415, &MeasuredCase::pressures},
      {"flows", "flow", "ml/s", "largest", "smallest", 1e-6, &MeasuredCase::flows},
      {"areas", "area", "mm^2", "largest", "smallest", 1e-6, &MeasuredCase::areas},
      {"displacements", "displacement", "mm", "largest", "smallest", 1e-3, &MeasuredCase::displacements},
  };
  return kinds;
}

Schema<MeasuredCase> MeasuredCase::schema() {
  const auto& kinds = measurement_kinds();
  return Schema<MeasuredCase>("measured", "What was measured in the patient; `post` and `report` compare with it.")
      .map("pressures", &MeasuredCase::pressures,
           measurement_schema(kinds[0], dimension::pressure, {"opening", "point", "plane"}),
           "Pressures by catheter or cuff, by name")
      .by_default()
      .map(
          "flows", &MeasuredCase::flows, measurement_schema(kinds[1], dimension::volume_flow, {"opening", "plane"}),
          "Flows by name: along the normal of a plane; of an opening into the vessel at the inlet, out of it elsewhere")
      .by_default()
      .map("areas", &MeasuredCase::areas, measurement_schema(kinds[2], dimension::area, {"plane"}),
           "Areas of a lumen in a plane, by name")
      .by_default()
      .map("displacements", &MeasuredCase::displacements, measurement_schema(kinds[3], dimension::length, {"point"}),
           "Distances of points from where they are at the start of the window of `post`, by name")
      .by_default()
      .check(check_names);
}

}  // namespace tunica::case_file
