#include "tunica/config/file_names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tunica::config {

namespace fs = std::filesystem;

std::string unusable_name(const std::string& text, const fs::path& full) {
  constexpr std::size_t longest_part = 255, longest_whole = 3800;  // bytes
  for (const fs::path& part : fs::path(text))
    if (part.native().size() > longest_part)
      return fmt::format("a file or folder name of {} bytes, `{}...`; at most {} are possible", part.native().size(),
                         part.native().substr(0, 40), longest_part);
  if (const auto size = fs::absolute(full).native().size(); size > longest_whole)
    return fmt::format("a path of {} bytes, at most {} are possible", size, longest_whole);
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (std::any_of(text.begin(), text.end(), control)) return "the name holds control characters";
  return {};
}

std::string other_than_wanted(const fs::path& full, const fs::file_status& status, const std::error_code& failure) {
  std::error_code ignored;
  if (fs::is_directory(status)) return "is a folder";
  if (fs::is_regular_file(status)) return "is a file";
  if (fs::exists(status) && fs::status_known(status)) return "is a device, a pipe or a socket";
  if (failure == std::errc::too_many_symbolic_link_levels) return "is a link that leads back to itself";
  if (fs::is_symlink(fs::symlink_status(full, ignored)))
    return fmt::format("is a link to {}, which is not there", fs::read_symlink(full, ignored).string());
  if (!fs::status_known(status)) return fmt::format("cannot be looked at ({})", failure.message());
  return {};
}

}  // namespace tunica::config
