// A table of a load, as the peers let it act.
#pragma once

#include <filesystem>

namespace tunica::stages {

/// Writes `target`, the table `from` (.flow, .dat: a line of points and modes, then times and values; .fcs: that of the
/// start first) with all times earlier by `seconds`. Exponents after D become those that every reader knows. Throws
/// InputError when `from` does not read, SolverError when `target` cannot be written. Not collective.
void write_early_table(const std::filesystem::path& from, double seconds, const std::filesystem::path& target);

}  // namespace tunica::stages
