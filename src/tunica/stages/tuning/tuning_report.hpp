// What `tunica tune` tells of its cycles: table, figures, JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/case.hpp"
#include "tunica/stages/tuning/identify.hpp"
#include "tunica/zerod/twin.hpp"

namespace tunica::stages {

/// One cycle in 3D and what the twin of that cycle says.
struct TuningCycle {
  zerod::Totals totals;
  Measured run;
  zerod::Vessel vessel;
  zerod::TwinCycle first, periodic;  ///< of the twin: from the same start, and when it repeats itself
  std::vector<double> fractions;     ///< of the mean outflow, in 3D

  zerod::Pressures measured() const { return first_pressures(run); }
  zerod::Pressures foreseen_first() const { return zerod::first_pressures(first, settled(run)); }
  /// Of the periodic state in 3D: what was measured, and the way that the twin has still to go, (7.6).
  zerod::Pressures foreseen() const;
  /// Largest difference from the targets, and of the mean from the twin's, relative.
  double miss(const case_file::TuningCase& outlets) const;
};

struct TuningReport {
  std::filesystem::path folder;
  artifacts::ProgramVersion program;
  artifacts::Inputs inputs;            ///< of the case
  std::string status = "running";      ///< or converged, not converged, stopped, failed
  std::optional<zerod::Vessel> probe;  ///< as the probe found it
  std::vector<TuningCycle> cycles;
  double seconds = 0;
};

/// Writes tuning.json, and with cycles tuning.csv, tuning.svg and pressure.svg. For one rank.
void write_report(const TuningReport& report, const case_file::Case& c);

/// What an earlier tuning.json tells.
struct EarlierTuning {
  std::optional<artifacts::Inputs> inputs;  ///< none when the file is cut off or altered
};
/// None when there is no such file.
std::optional<EarlierTuning> find_tuning(const std::filesystem::path& folder);

}  // namespace tunica::stages
