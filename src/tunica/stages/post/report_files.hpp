// Tables, plots and fields of what was found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tunica/stages/post/findings.hpp"

namespace tunica::stages::post {

/// Each writes into the folder and returns the names of its files. They throw SolverError when that fails.
std::vector<std::string> write_tables(const Findings& f, const std::filesystem::path& folder);
std::vector<std::string> write_plots(const Findings& f, const std::filesystem::path& folder);
/// For ParaView, in mm: wall_shear.vtp, stress.vtu, stations.vtp, tears.vtp.
std::vector<std::string> write_fields(const Findings& f, const std::filesystem::path& folder);

}  // namespace tunica::stages::post
