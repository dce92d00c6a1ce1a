// Plots of the histories that a run writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::drawing {

struct HistoryPlotOptions {
  std::filesystem::path history;     ///< a .csv of a run: one header line, then numbers
  std::vector<std::string> columns;  ///< each draws all columns whose header contains it
  std::string x = "time";            ///< the first column whose header contains this
  std::filesystem::path output;      ///< .svg or .png
  std::string title{};
};

/// Draws the chosen columns as curves; returns their headers. Throws InputError: missing file, no such column (with
/// those that exist), a value that is no number (with its line), columns of different units.
std::vector<std::string> plot_history(const HistoryPlotOptions& options);

}  // namespace tunica::drawing
