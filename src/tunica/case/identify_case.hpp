// The file of `tunica identify`: which keys of a case are found from what was measured.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tunica/config/schema.hpp"

namespace tunica::case_file {

/// What is found: the value of one or several keys, or a factor on theirs.
struct IdentifiedKey {
  std::vector<std::string> keys{}, factor_on{};  ///< one of both is empty
  std::vector<std::string> between{};            ///< two ends, with unit
  std::string start{};                           ///< with unit; empty: the case's value, 1 for a factor
};

struct IdentifyCase {
  std::string title;
  std::filesystem::path case_file;
  std::vector<std::pair<std::string, IdentifiedKey>> parameters{};
  std::vector<std::string> measurements{};  ///< patterns, as areas/*; empty: all
  double tolerance = 0.01;                  ///< relative change of the parameters at which it ends
  double difference = 0.05;                 ///< of a parameter, relative, for the derivatives
  int independent_values = 10;              ///< that a measured curve counts for at most
  int max_runs = 30;
  std::filesystem::path output;

  static config::Schema<IdentifyCase> schema();
};

/// Throws InputError with all problems of the file.
config::Parsed<IdentifyCase> read_identify_case(const std::filesystem::path& file);

}  // namespace tunica::case_file
