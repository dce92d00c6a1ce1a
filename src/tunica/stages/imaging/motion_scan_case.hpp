// The file of `tunica synthesise --motion`: a computed beat and how gated CT and a segmentation show it.
#pragma once

#include <filesystem>
#include <string>

#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/imaging/scan_settings.hpp"
#include "tunica/stages/imaging/computed_beat.hpp"

namespace tunica::stages {

struct MotionScanCase {
  ImagedBeat beat;
  std::int64_t phases = 10;
  imaging::ScanSettings scan;
  std::filesystem::path output;

  static config::Schema<MotionScanCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MotionScanCase> read_motion_scan_case(const std::filesystem::path& file);

/// Writes labels_000.nrrd, ... and truth.csv, the areas of the planes. Phases are equal parts of the period from the
/// start of the beat on. Returns the section `phases` of a file of `tunica motion` for them. Throws InputError when the
/// fields do not cover the beat, and when images are there and `overwrite` is false. For one rank.
std::string motion_scan_to_files(const MotionScanCase& scan, bool overwrite, const files::Say& say);

}  // namespace tunica::stages
