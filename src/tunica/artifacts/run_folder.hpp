// Is what a run has left still there?
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::artifacts {

/// Files of the time series of these regions up to `until` [s] that are gone, each with the series that names it, and
/// series that are gone. Throws InputError when a series cannot be read. Not collective, as all here.
std::vector<std::string> missing_fields(const std::filesystem::path& folder, const std::vector<std::string>& regions,
                                        double until);

/// Can a run go on in this folder without being told how?
struct Continuation {
  bool possible = false;
  std::vector<std::string> warnings;  ///< checkpoints that are passed over; why it is not possible though it was begun
};
Continuation find_continuation(const std::filesystem::path& folder);

}  // namespace tunica::artifacts
