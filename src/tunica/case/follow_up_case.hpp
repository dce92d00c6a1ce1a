// The file of `tunica follow-up`: scans of one patient with their dates.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tunica/config/schema.hpp"
#include "tunica/meshing/geometry.hpp"

namespace tunica::case_file {

/// Exactly one of `case_file` and `geometry` is given.
struct Scan {
  std::string date;  ///< 2024-05-31
  std::optional<std::filesystem::path> case_file{};
  std::optional<meshing::Geometry> geometry{};
};

struct FollowUpCase {
  std::string title;
  std::optional<std::filesystem::path> case_file{};   ///< whose geometry those of the scans replace
  std::vector<std::pair<std::string, Scan>> scans{};  ///< in order of their dates
  double spacing = 4e-3;                              ///< of sections along the aorta [m]
  std::filesystem::path output;

  static config::Schema<FollowUpCase> schema();
};

/// Throws InputError with all problems of the file.
config::Parsed<FollowUpCase> read_follow_up_case(const std::filesystem::path& file);

/// Days of "2024-05-31" since 1970; none where it is no day of the calendar written so.
std::optional<int> day_of(const std::string& date);

inline constexpr double days_in_a_year = 365.25;

}  // namespace tunica::case_file
