// The section `prestress` of a case file.
#pragma once

#include <filesystem>
#include <optional>

#include "tunica/config/schema.hpp"
#include "tunica/coupling/settings.hpp"

namespace tunica::case_file {

/// Steady flow in the rigid vessel, whose traction loads the wall.
struct SteadyFlow {
  double pressure = 0.0;         ///< of the outlets: diastolic [Pa]
  std::optional<double> inflow;  ///< through the one face with a flow condition [m^3/s]
  double step = 5e-3;            ///< s
  int steps = 400;               ///< at most
  double tolerance = 1e-3;       ///< change of velocity and pressure in a step, of the largest, that counts as steady

  static config::Schema<SteadyFlow> schema();
};

struct PrestressCase {
  coupling::PrestressSettings fixed_point;
  std::optional<SteadyFlow> flow;  ///< present where the case solves the flow
  double load_time = 0.0;          ///< of the loads on the wall [s]
  std::filesystem::path output;

  static config::Schema<PrestressCase> schema();
};

}  // namespace tunica::case_file
