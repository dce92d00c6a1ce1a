// From the file of a follow-up to a case file for each of its scans.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tunica/case/follow_up_case.hpp"

namespace tunica::pipeline {

/// A scan as a chain of its own.
struct ScanCase {
  std::string name, date;
  double years = 0;            ///< since the first scan
  std::filesystem::path file;  ///< its case file
  std::string text{};          ///< that the file gets; empty: it is the user's own
};

struct FollowUpPlan {
  case_file::FollowUpCase settings;
  std::filesystem::path file, output;
  std::vector<ScanCase> scans;
};

/// `output`: instead of the folder that the file names; `run`: the beats are computed, too. Writes nothing. Throws
/// InputError with all that is wrong in the file and in the cases of all scans as far as their keys and values tell:
/// scans that are meshed by other settings than the first one, and names of openings that are not those of the first.
/// Not collective, as all here.
FollowUpPlan plan_follow_up(const std::filesystem::path& file, const std::optional<std::filesystem::path>& output,
                            bool run);

/// Writes the case files of scans with a geometry and looks at each as `tunica run` would before its first stage.
/// Throws InputError with the problems of all.
void write_and_check_cases(const FollowUpPlan& plan);

}  // namespace tunica::pipeline
