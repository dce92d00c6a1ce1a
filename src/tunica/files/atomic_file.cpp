#include "tunica/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "tunica/base/error.hpp"

namespace tunica::files {

namespace fs = std::filesystem;

namespace {

const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
      return "free some space there, or choose a folder on another disk";
    case EDQUOT:
      return "remove files of yours there, ask for a larger quota, or choose a folder on another disk";
    case EFBIG:
      return "raise the limit of file sizes (`ulimit -f`), or choose a file system that takes larger files";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EACCES:
    case EPERM:
    case EROFS:
      return "make the folder writable, or choose another one";
    case ENOENT:
    case ENOTDIR:
      return "check that the folder exists and was not moved meanwhile";
    case EISDIR:
      return "move that folder away, or choose another name";
    default:
      return "check the disk and the connection to it";
  }
}

[[noreturn]] void refuse(const fs::path& path, int error) {
  throw SolverError(fmt::format("cannot write {}: {}", path.string(), write_failure(error)));
}

/// Error number, 0: none.
int write_all(int descriptor, const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t n = ::write(descriptor, data, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    data += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return 0;
}

// Pipes, devices and some file systems know no fsync, and say so.
int bring_to_disk(int descriptor) {
  int result = 0;
  do result = fsync(descriptor);
  while (result != 0 && errno == EINTR);
  const bool unknown = errno == EINVAL || errno == ENOTSUP || errno == ENOSYS || errno == EROFS;
  return result == 0 || unknown ? 0 : errno;
}

/// The new name is on the disk when the folder is.
int bring_folder_to_disk(const fs::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;  // one may write in a folder that one may not list
  const int error = bring_to_disk(descriptor);
  ::close(descriptor);
  return error == EBADF ? 0 : error;
}

/// Where a symbolic link leads, so that the link stays one.
fs::path followed(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

std::string write_failure(int error) { return fmt::format("{}; {}", std::strerror(error), remedy(error)); }

AtomicFile::AtomicFile(const fs::path& path) : name_(path), path_(followed(path)) {
  struct stat there {};
  const bool exists = stat(path_.c_str(), &there) == 0;
  if (exists && S_ISDIR(there.st_mode)) refuse(name_, EISDIR);
  if (!exists || S_ISREG(there.st_mode)) temporary_ = path_.string() + temporary_ending;
  const int create = temporary_.empty() ? 0 : O_CREAT | O_TRUNC;
  descriptor_ = open((temporary_.empty() ? path_ : temporary_).c_str(), O_WRONLY | O_CLOEXEC | create, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();  // there is none to be removed
    refuse(name_, error);
  }
}

AtomicFile::~AtomicFile() { close(); }

void AtomicFile::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(int error) {
  close();
  refuse(name_, error);
}

void AtomicFile::write(const void* data, std::size_t bytes) {
  if (const int error = write_all(descriptor_, static_cast<const char*>(data), bytes); error != 0) fail(error);
}

void AtomicFile::finish() {
  if (const int error = bring_to_disk(descriptor_); error != 0) fail(error);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  temporary_.clear();
  if (const int error = bring_folder_to_disk(path_.parent_path()); error != 0) fail(error);
}

void write_atomically(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

void write_atomically(const fs::path& path, const std::string& ending,
                      const std::function<void(const fs::path& temporary)>& write) {
  const fs::path name = followed(path), temporary = name.string() + temporary_ending + ending;
  std::error_code ignored;
  if (fs::is_directory(name, ignored)) refuse(name, EISDIR);
  try {
    write(temporary);
    sync_file(temporary);
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
  if (std::rename(temporary.c_str(), name.c_str()) != 0) {
    const int error = errno;
    fs::remove(temporary, ignored);
    refuse(name, error);
  }
  if (const int error = bring_folder_to_disk(name.parent_path()); error != 0) refuse(name, error);
}

bool holds(const fs::path& path, std::string_view text) {
  std::ifstream stream(path, std::ios::binary);
  return stream && std::string(std::istreambuf_iterator<char>(stream), {}) == text;
}

void append(const fs::path& path, std::string_view text) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);  // one that is gone is not made anew
  if (descriptor < 0) refuse(path, errno);
  const off_t end = lseek(descriptor, 0, SEEK_END);
  int error = end < 0 && errno != ESPIPE ? errno : write_all(descriptor, text.data(), text.size());
  // Half a line is worse than none. Shortening a file needs no space.
  if (error != 0 && end >= 0) [[maybe_unused]]
    const int cut = ftruncate(descriptor, end);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) refuse(path, error);
}

void sync_file(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) refuse(path, errno);
  const int error = bring_to_disk(descriptor);
  ::close(descriptor);
  if (error != 0) refuse(path, error);
}

}  // namespace tunica::files
