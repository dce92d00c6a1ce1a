// The section `outlets` of a case file: what the outlets shall bring about.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/bc/conditions.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/zerod/twin.hpp"

namespace tunica::case_file {

struct TuningCase {
  double systolic = 0.0, diastolic = 0.0;                 ///< targets at the face with the inflow [Pa]
  std::vector<std::pair<std::string, double>> fractions;  ///< face, share of the mean outflow; they add up to 1
  double distal_share = 0.9;                              ///< k_d = R_d / (R_p + R_d)
  double distal_pressure = 0.0;                           ///< P_d [Pa]
  double tolerance = 0.02;                                ///< of systolic, diastolic and mean pressure
  int max_cycles = 2;
  std::optional<double> step;  ///< of the tuning runs [s]; none: a two-hundredth of the period
  std::filesystem::path output;
  std::optional<std::filesystem::path> given_file;  ///< none: in `output`
  bool continued = false;                           ///< P_c goes on from the state that the run starts from

  double mean() const { return (systolic + 2 * diastolic) / 3; }  ///< [Pa]
  std::filesystem::path file() const { return given_file.value_or(output / "outlets.yaml"); }
  zerod::FlowSplit flow_split() const;  ///< in the order of `fractions`
  static config::Schema<TuningCase> schema();
};

/// Takes the place of the Windkessels where only shares of the flow matter: resistances in inverse proportion.
std::vector<std::pair<std::string, bc::Condition>> provisional_outlets(const TuningCase& outlets);

}  // namespace tunica::case_file
