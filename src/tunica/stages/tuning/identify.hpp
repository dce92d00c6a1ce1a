// What a run in 3D tells about its vessel, for the 0D twin.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/case/case.hpp"
#include "tunica/zerod/twin.hpp"

namespace tunica::stages {

/// Histories of a run, one entry for each step, at the time where the flow is balanced. SI.
struct Measured {
  std::vector<double> times, durations;                           ///< durations of the steps
  std::vector<double> inlet_pressure;                             ///< mean of the face
  std::vector<double> lumen_volume;                               ///< [m^3]
  std::vector<std::vector<double>> outlet_flow, outlet_pressure;  ///< [outlet][step]; pressure: mean of the face
};

/// Reads faces.csv, balance.csv and steps.csv of a run with the output units of `c`, up to time `until` [s]. Throws
/// InputError when they do not read. Not collective.
Measured read_measured(const std::filesystem::path& results, const case_file::Case& c, const std::string& inlet,
                       double until);

/// Compliance from volume against inlet pressure, resistance and inertance of each path from pressure drop against flow
/// and its rate, both by least squares and not below zero, (7.4). At least five steps.
zerod::Vessel identify(const Measured& run, bool rigid);

/// State of the twin at the first step of a run whose outlets started from `stored` [Pa]. The pressure of a compliant
/// vessel is the one that belongs to its volume: waves have not yet passed through it, and the inlet does not speak for
/// the whole.
zerod::TwinState start_of(const Measured& run, const zerod::Vessel& vessel, const std::vector<double>& stored);

/// Time after which a run answers to its vessel, not to its sudden start [s].
double settled(const Measured& run);
zerod::Pressures first_pressures(const Measured& run);
std::vector<double> mean_flows(const Measured& run);

}  // namespace tunica::stages
