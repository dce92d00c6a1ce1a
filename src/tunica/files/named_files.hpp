// Files that hold only a part of what they stand for, and name the others: the header of an image, the list of a
// series.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::files {

/// What a file names, as it is written there: absolute, or counted from the folder of the file. By the extension:
/// detached headers of NRRD and MetaImage with their lists and numbered names, the lists of instants of results
/// (.series), and the XML files of VTK that hold others together (.pvd, .pvtu, .pvtp, .vtm). Empty for all other kinds,
/// and for a file that cannot be read.
std::vector<std::string> named_files(const std::filesystem::path& file);

}  // namespace tunica::files
