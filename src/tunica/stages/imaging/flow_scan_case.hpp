// The file of `tunica synthesise --flow`: a computed beat and how its velocities are imaged.
#pragma once

#include <filesystem>
#include <string>

#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/flow_imaging/synthetic_series.hpp"
#include "tunica/stages/imaging/computed_beat.hpp"

namespace tunica::stages {

struct FlowScanCase {
  ImagedBeat beat;
  flow_imaging::PhaseContrast scan;
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
