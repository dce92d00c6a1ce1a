// Outputs are tried before the work: a name that is too long is found in a second, not after hours of computing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::files {

/// Makes `folder` with those above it. Throws InputError when it cannot be made or is something else.
void make_folder(const std::filesystem::path& folder);

/// Can these files be written? Tries it, without touching what is there; in folders that are still to be made, only
/// whether the names are possible. `files` relative to `folder`. Throws InputError with all that cannot.
void try_outputs(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

/// The same for one file, whose folder is not made for it.
void try_output(const std::filesystem::path& file);

/// Is it the name that the pattern stands for? A * in it stands for any characters; there is one at most.
bool fits(const std::string& pattern, const std::string& name);

/// Removes the files of a folder whose names fit one of the patterns: outputs of an earlier call that the next one may
/// have fewer of. Throws InputError where one cannot be removed.
void remove_outputs(const std::filesystem::path& folder, const std::vector<std::string>& patterns);

/// Throws InputError when a folder, a device or the like stands under the name of a file that tunica keeps in a folder
/// of results: reading it fails in as many ways as there are libraries.
void refuse_other_than_file(const std::filesystem::path& file);

}  // namespace tunica::files
