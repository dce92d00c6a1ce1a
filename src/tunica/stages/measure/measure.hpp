// `tunica measure`: flows through planes and openings from velocity images, and profiles for openings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/case/measured_settings.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"
#include "tunica/flow_imaging/plane_series.hpp"
#include "tunica/flow_imaging/read_series.hpp"

namespace tunica::stages {

/// Velocities of an opening as the condition of a run.
struct ProfileSettings {
  std::string opening;
  std::optional<double> smoothing;  ///< m
  double slab = 2;                  ///< voxels
  std::int64_t times = 200;         ///< of the table
};

/// The file of `tunica measure`.
struct MeasureCase {
  std::filesystem::path case_file;
  std::optional<flow_imaging::SeriesFiles> velocity;
  std::optional<flow_imaging::PlaneFiles> plane;  ///< in place of `velocity`: a profile alone
  std::optional<int> background = 1;              ///< order of the polynomial of the offset; none: it is left
  std::optional<double> noise;                    ///< of a voxel [m/s]; none: found in static tissue
  std::optional<double> smoothing;                ///< m
  double slab = 1.5;                              ///< voxels
  std::vector<std::pair<std::string, case_file::MeasuredPlane>> planes;
  bool openings = true;
  bool balance = true;
  std::optional<ProfileSettings> profile;
  std::filesystem::path output;

  static config::Schema<MeasureCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<MeasureCase> read_measure_case(const std::filesystem::path& file);

/// Writes flows.csv, flows.json, flows.svg and profile_<opening>.csv into the folder of the output; what was done to
/// the velocities and a table of the flows go to `say`. Planes and openings are found in the mesh before any image is
/// read. Throws InputError for planes outside the lumen, unknown openings, images that do not read, files that are
/// there and `overwrite` is false. Not collective: for one rank.
void measure(const MeasureCase& c, bool overwrite, const files::Say& say);

}  // namespace tunica::stages
