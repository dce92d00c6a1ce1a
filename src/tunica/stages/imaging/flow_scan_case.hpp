// The file of `tunica synthesise --flow`: a computed beat and how its velocities are imaged.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/measured_settings.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/flow_imaging/synthetic_series.hpp"

namespace tunica::stages {

struct FlowScanCase {
  std::filesystem::path case_file;
  std::optional<std::filesystem::path> results;  ///< folder of the fields, instead of that of the case
  double period = 0;                             ///< s
  std::optional<double> until;                   ///< end of the beat [s]; none: the last field
  flow_imaging::PhaseContrast scan;
  std::vector<std::pair<std::string, case_file::MeasuredPlane>> planes;
  std::filesystem::path output;

  static config::Schema<FlowScanCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<FlowScanCase> read_flow_scan_case(const std::filesystem::path& file);

/// Writes the images velocity_x.nii.gz, velocity_y, velocity_z and magnitude, and the truth that they show: truth.csv,
/// the flows of openings and planes at the times of the frames, and truth_<inlet>.csv, the velocities at its nodes.
/// Returns the section `velocity` of a file of `tunica measure` for them. Throws InputError when the fields do not
/// cover the beat, and when images are there and `overwrite` is false. Not collective: for one rank.
std::string flow_scan_to_files(const FlowScanCase& scan, bool overwrite, const files::Say& say);

}  // namespace tunica::stages
