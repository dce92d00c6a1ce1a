// The one place that writes files. A file appears under its name complete or not at all: it is written under a
// temporary name beside it, brought to the disk and renamed. Whatever fails on the way says which file, why, and what
// to do.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tunica::files {

/// Ending of a file that is being written. One that a killed process has left is overwritten by the next.
constexpr const char* temporary_ending = ".part";

/// A file that is written in pieces. Without finish() nothing appears under its name and an older file stays as it was.
/// What stands under the name and is no regular file (a device, a pipe) is written to as it is. All member functions
/// throw SolverError with file, cause and remedy.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, std::size_t bytes);
  /// Brings the file to the disk and gives it its name. Nothing is written afterwards.
  void finish();

 private:
  [[noreturn]] void fail(int error);
  void close();

  std::filesystem::path name_;       ///< as it was given
  std::filesystem::path path_;       ///< where symbolic links lead
  std::filesystem::path temporary_;  ///< empty where the file is written in place
  int descriptor_ = -1;
};

/// Writes `text` as an AtomicFile.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// The same for a library that writes to a name: `write` writes the whole file under the name that it is given, which
/// ends in `ending`, and throws when it cannot.
void write_atomically(const std::filesystem::path& path, const std::string& ending,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// Is `text` what the file holds? Without one, no.
bool holds(const std::filesystem::path& path, std::string_view text);

/// Adds `text` to a file that is there. When that fails, the file holds what it held before. Survives the end of this
/// process; see sync_file() for that of the machine. Throws SolverError.
void append(const std::filesystem::path& path, std::string_view text);

/// Brings what was written to a file to the disk. Throws SolverError.
void sync_file(const std::filesystem::path& path);

/// "No space left on device; free some ...": cause and remedy of a failed write.
std::string write_failure(int error);

}  // namespace tunica::files
