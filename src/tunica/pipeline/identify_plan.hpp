// From the file of an identification to the case of any of its runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/identify_case.hpp"
#include "tunica/case/measured_settings.hpp"
#include "tunica/pipeline/point.hpp"

namespace tunica::pipeline {

/// What is found; values are in its unit.
struct IdentifiedParameter {
  std::string name;
  std::vector<std::string> keys{};      ///< of the case, with dots
  std::vector<std::string> factored{};  ///< for a factor: the values of the case that it multiplies, one for each key
  std::string unit{};                   ///< empty: none
  double low = 0, high = 0, start = 0;

  bool is_factor() const { return !factored.empty(); }
  std::string text(double value) const;   ///< "12 kPa", for the case
  std::string shown(double value) const;  ///< the same for readers
  std::string label() const;              ///< "flap [kPa]"
  /// What the case holds for a value, by key.
  std::vector<std::pair<std::string, std::string>> settings(double value) const;
};

/// One of the measurements that the values are found from.
struct ChosenMeasurement {
  const case_file::MeasurementKind* kind;
  std::string name;
  bool curve = false;
  double independent = 0;  ///< values that it counts for

  std::string path() const;  ///< "areas/false_lumen"
};

struct IdentifyPlan {
  case_file::IdentifyCase settings;
  std::filesystem::path file, output{};  ///< of the identification; folder of results
  config::Document base{};               ///< the case
  std::vector<IdentifiedParameter> parameters{};
  std::vector<ChosenMeasurement> measurements{};
  std::map<std::string, std::filesystem::path> shared{};  ///< folders of the stages that all runs have in common

  double independent() const;                                 ///< values of all measurements
  std::string text(const std::vector<double>& values) const;  ///< "support = 1e7 N/m^3, flap = 0.5 MPa"
};

/// `output`: instead of the folder that the file names. Writes nothing. Throws InputError with all that is wrong in the
/// file, and in the case at the start and at both ends of the bounds, as far as keys and values tell. Not collective,
/// as all here.
IdentifyPlan plan_identify(const std::filesystem::path& file, const std::optional<std::filesystem::path>& output);

/// A run with these values; numbers count from 1.
PointCase case_of_run(const IdentifyPlan& plan, std::size_t run, const std::vector<double>& values);

/// The case with these values, in the folder of results and with results of its own beside it.
std::string identified_text(const IdentifyPlan& plan, const std::vector<double>& values);

}  // namespace tunica::pipeline
