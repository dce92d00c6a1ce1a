// `tunica material` and `tunica verify`, for callers that need not know a law.
#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>

namespace tunica::stages {

/// Runs all tests, writes <test>.csv and <test>.svg (or .png) into the folder of results and a summary to `screen`.
/// Throws InputError, SolverError.
void run_material(const std::filesystem::path& file, const std::optional<std::filesystem::path>& directory,
                  std::FILE* screen);

/// Runs both tests; writes uniaxial.csv, shear.csv, comparisons.csv, uniaxial.svg, shear.svg into `folder` and a table
/// to `screen`. True when every comparison passed. For one rank, within a parallel::Session. Throws InputError,
/// SolverError.
bool verify(const std::filesystem::path& folder, std::FILE* screen);

}  // namespace tunica::stages
