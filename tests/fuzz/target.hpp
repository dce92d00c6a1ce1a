// What a fuzz target gives to the driver. One program has one target; the driver is its main().
#pragma once

#include <filesystem>
#include <string>

namespace tunica::fuzz {

/// Name of the folder of its corpus.
extern const char* const target_name;

/// Once, in the process that reads, before the first input.
void start_target();

/// Reads a file as the program does. `kind` is the folder of the corpus that the file comes from. It may throw
/// InputError and SolverError and nothing else.
void read_one(const std::filesystem::path& file, const std::string& kind);

}  // namespace tunica::fuzz
