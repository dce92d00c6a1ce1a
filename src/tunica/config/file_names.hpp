// Names of files and folders as a case file gives them: what is wrong with them, in words.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace tunica::config {

/// Why no file system can have this name; empty when nothing is wrong with it. Files with longer names are made in
/// folders, so something is left for them.
std::string unusable_name(const std::string& text, const std::filesystem::path& full);

/// What stands under a name that is not what it should be; empty when nothing does.
std::string other_than_wanted(const std::filesystem::path& full, const std::filesystem::file_status& status,
                              const std::error_code& failure);

}  // namespace tunica::config
