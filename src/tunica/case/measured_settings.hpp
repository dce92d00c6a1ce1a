// The section `measured` of a case file: what was measured in the patient, for comparison with what is computed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/config/schema.hpp"

namespace tunica::case_file {

/// A plane through a lumen; the piece of the lumen in it that is nearest to `centre` counts.
struct MeasuredPlane {
  Vec3<double> centre{};  ///< m
  Vec3<double> normal{};  ///< of any length; flow along it is positive

  static config::Schema<MeasuredPlane> schema();
};

/// A measured course in time from a table.
struct MeasuredCurve {
  std::filesystem::path file;
  std::string time_column, value_column;
  std::string uncertainty_column;            ///< empty: `uncertainty` holds throughout
  double time_unit = 1.0, value_unit = 1.0;  ///< s, SI
  double shift = 0.0;                        ///< added to the times [s]
};

/// One measured quantity at one place: some of largest, smallest, mean; or a curve. SI units.
struct Measurement {
  std::optional<std::string> opening;  ///< face of the lumen
  std::optional<std::string> point;    ///< one of `output.points`
  std::optional<MeasuredPlane> plane;
  std::optional<double> largest, smallest, mean;
  std::optional<MeasuredCurve> curve;
  std::optional<double> uncertainty;  ///< one standard deviation
};

using Measurements = std::vector<std::pair<std::string, Measurement>>;

struct MeasuredCase {
  Measurements pressures, flows, areas, displacements;

  static config::Schema<MeasuredCase> schema();
};

/// What kinds of measurements have in common for whoever goes through all of them.
struct MeasurementKind {
  const char *key, *quantity, *unit, *largest, *smallest;
  double si;  ///< of the unit
  Measurements MeasuredCase::*entries;
};
const std::vector<MeasurementKind>& measurement_kinds();

/// Points that measurements name and the case does not record, and curves that do not read.
std::vector<Problem> check_measured(const MeasuredCase& measured, const std::vector<std::string>& points);

/// A curve as it was measured, SI.
struct MeasuredCourse {
  std::vector<double> times, values, deviations;  ///< deviations: one standard deviation of each value
};
/// Throws InputError for a table that does not read, lacks a column, is shorter than two lines, whose times do not
/// ascend, or a deviation that is not above zero.
MeasuredCourse read_course(const Measurement& measurement);

}  // namespace tunica::case_file
