// Files to draw: which ones a time series means, and reading them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tunica::drawing {

/// Files of one time step.
struct SeriesStep {
  std::optional<double> time;  ///< none for a file that is no series
  std::vector<std::string> files;
};

/// Steps of a .hdf.series or .pvd time series, ordered by time, with paths resolved against its folder; a file of any
/// other kind is one step. Throws InputError if the series cannot be read or is empty.
std::vector<SeriesStep> read_series(const std::string& file);

/// The step nearest to `time`, or the last one.
const SeriesStep& pick_step(const std::vector<SeriesStep>& steps, std::optional<double> time);

}  // namespace tunica::drawing
