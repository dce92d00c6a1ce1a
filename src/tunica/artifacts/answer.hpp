// What a run has found, in a few lines for the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::artifacts {

/// A line for each opening with least, mean and largest pressure and flow of `faces` (faces.csv) after time `from` of
/// the unit of that file, in its units; no more than twelve, and none without rows. Throws InputError as
/// files::read_csv.
std::vector<std::string> answer_lines(const std::filesystem::path& faces, const std::vector<std::string>& openings,
                                      double from);

}  // namespace tunica::artifacts
