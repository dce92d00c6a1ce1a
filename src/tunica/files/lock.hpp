// A folder has one owner at a time: the process that writes into it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tunica::files {

/// Name of the lock in the folder. It says who owns the folder since when, in YAML.
constexpr const char* lock_name = ".tunica.lock";

/// Holds a folder while it lives. The lock is a file that appears complete under its name, by a hard link, which is one
/// action on network file systems too. Where its process has ended without removing it (killed, or the machine was
/// switched off), the next one takes the folder over; of several that try, one does. A process that holds a folder
/// gets it again: the inner lock then does nothing. Not collective: for rank 0.
class FolderLock {
 public:
  FolderLock() = default;  ///< holds nothing
  /// Makes the folder when it is missing. Throws InputError when another process owns it, or may do so (one on another
  /// host cannot be asked), and when nothing can be written there.
  explicit FolderLock(const std::filesystem::path& folder);
  /// Removes the lock, and the folder when it was made for the lock and is empty.
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

  /// Whose lock was taken over, as a warning; empty: nobody's.
  const std::string& taken_over() const { return taken_over_; }

 private:
  void release() noexcept;

  std::filesystem::path file_;  ///< empty: there is nothing to be removed
  std::int64_t holder_ = 0;     ///< its process number: a copy of the process leaves the lock alone
  bool made_folder_ = false;
  std::string taken_over_;
};

/// Throws InputError when another process owns the folder, as FolderLock does, without locking it.
void refuse_if_owned_by_another(const std::filesystem::path& folder);

}  // namespace tunica::files
