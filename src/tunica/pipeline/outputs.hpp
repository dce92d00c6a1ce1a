// Is what a stage has left still in its folder?
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tunica::pipeline {

/// Size by path, relative to the folder of a stage.
using Outputs = std::map<std::string, std::uintmax_t>;

/// The files in `folder` whose relative path fits one of the patterns. What lies in the folder of another stage within
/// it is left out.
Outputs outputs_of(const std::filesystem::path& folder, const std::vector<std::string>& patterns);

/// Those that are gone, have another size, or are checkpoints that are not whole.
std::vector<std::string> lost_outputs(const std::filesystem::path& folder, const Outputs& recorded);

/// "lumen_000004.hdf is missing or damaged", "lumen.hdf.series and 3 more are missing or damaged".
std::string text_of_lost(const std::vector<std::string>& lost);

}  // namespace tunica::pipeline
