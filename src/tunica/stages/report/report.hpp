// `tunica report`: one page with what the stages of a case have done and found.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "tunica/artifacts/manifest.hpp"
#include "tunica/case/report_settings.hpp"
#include "tunica/config/schema.hpp"
#include "tunica/files/phases.hpp"

namespace tunica::stages {

/// The file of `tunica report`, which the chain writes.
struct ReportCase {
  std::string title;
  std::filesystem::path case_file;                      ///< printed at the end of the page
  std::map<std::string, std::filesystem::path> stages;  ///< folder by the name of the stage
  case_file::ReportSettings settings;
  double metres_per_unit = 1e-3;  ///< of the coordinates in the fields of the run
  std::filesystem::path output;
  std::optional<std::filesystem::path> convergence;  ///< what `tunica converge` has found of the case

  static config::Schema<ReportCase> schema();
};

/// Throws InputError with all problems.
config::Parsed<ReportCase> read_report_case(const std::filesystem::path& file);

/// Writes report.html, which needs no other file: summary and times of the stages; quality of mesh and directions;
/// convergence of prestress and outlets; curves of the run; figures of the cycle; pictures; the case file. What is
/// missing is named with the reason. Returns the name of the page.
///
/// Throws InputError when it is there and `overwrite` is false, or a file of a stage does not read; SolverError when
/// the page cannot be written. Not collective.
std::filesystem::path report_to_file(const ReportCase& report, const artifacts::ProgramVersion& program, bool overwrite,
                                     const files::Say& say);

}  // namespace tunica::stages
