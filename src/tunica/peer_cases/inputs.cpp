#include "tunica/peer_cases/inputs.hpp"

#include <algorithm>

namespace tunica::peer_cases {

namespace fs = std::filesystem;

namespace {

bool same(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::equivalent(one, other, none);
}

bool names(const Entry& entry, const fs::path& folder, const fs::path& path) {
  if (!entry.file.empty() && same(folder / entry.file, path)) return true;
  if (!entry.value.empty() && same(folder / entry.value, path)) return true;
  return std::any_of(entry.entries.begin(), entry.entries.end(),
                     [&](const Entry& below) { return names(below, folder, path); });
}

}  // namespace

bool is_input(const PeerFile& file, const fs::path& path) {
  return same(file.path, path) || names(file.root, file.path.parent_path(), path);
}

}  // namespace tunica::peer_cases
