#include "tunica/files/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "temporary_folder.hpp"
#include "text.hpp"
#include "tunica/base/error.hpp"

namespace tunica::files {
namespace {

namespace fs = std::filesystem;
using test::slurp;
using tunica::test::contains;

std::string failure(const std::function<void()>& action) {
  try {
    action();
  } catch (const SolverError& error) {
    return error.what();
  }
  return "none";
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// While it lives, no file of this process may become longer.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : earlier_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &earlier_);
    const rlimit limit{bytes, earlier_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &earlier_);
    std::signal(SIGXFSZ, earlier_signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit earlier_{};
  void (*earlier_signal_)(int);
};

TEST(AtomicFile, AppearsWholeAndReplacesWhatWasThere) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  write_atomically(path, "one");
  {
    AtomicFile file(path);
    file.write("tw", 2);
    EXPECT_EQ(slurp(path), "one");
    file.write("o", 1);
    file.finish();
  }
  EXPECT_EQ(slurp(path), "two");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, LeavesNothingWhenItIsNotFinished) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  { AtomicFile(path).write("half", 4); }
  EXPECT_EQ(entries(folder.path()), 0u);
}

TEST(AtomicFile, KeepsALinkAndWhatItLeadsTo) {
  const test::TemporaryFolder folder;
  write_atomically(folder.path() / "target", "old");
  fs::create_symlink("target", folder.path() / "link");
  write_atomically(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(slurp(folder.path() / "target"), "new");
}

TEST(AtomicFile, LimitOfFileSizeIsAnErrorAndKeepsTheOldFile) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  write_atomically(path, "old");
  const FileSizeLimit limit(1000);
  const auto message = failure([&] { write_atomically(path, std::string(5000, 'x')); });
  EXPECT_TRUE(contains(message, "cannot write " + path.string() + ": File too large; raise the limit")) << message;
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(AtomicFile, FullDiskIsAnErrorAndLeavesNothing) {
  const test::TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  fs::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "no file system can be mounted here: " << std::strerror(errno);
  const auto message = failure([&] { write_atomically(disk / "a", std::string(100000, 'x')); });
  const auto left = entries(disk);
  write_atomically(disk / "b", "fits");
  umount(disk.c_str());
  EXPECT_TRUE(contains(message, "No space left on device; free some space")) << message;
  EXPECT_EQ(left, 0u);
}

// The device takes no byte, like a full disk; what is no regular file is not renamed over.
TEST(AtomicFile, FullDeviceIsAnErrorThatNamesTheFileAsItWasGiven) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  fs::create_symlink("/dev/full", path);
  const auto message = failure([&] { write_atomically(path, "text"); });
  EXPECT_TRUE(contains(message, "cannot write " + path.string() + ": No space left on device")) << message;
  struct stat device {};
  ASSERT_EQ(stat("/dev/full", &device), 0);
  EXPECT_TRUE(S_ISCHR(device.st_mode));
  EXPECT_FALSE(fs::exists("/dev/full.part"));
}

TEST(AtomicFile, SaysWhatIsWrongWithAName) {
  const test::TemporaryFolder folder;
  write_atomically(folder.path() / "file", "");
  fs::create_directory(folder.path() / "folder");
  const auto of = [&](const fs::path& name) { return failure([&] { write_atomically(folder.path() / name, "x"); }); };
  EXPECT_TRUE(contains(of("file/a"), "Not a directory")) << of("file/a");
  EXPECT_TRUE(contains(of("none/a"), "No such file or directory")) << of("none/a");
  EXPECT_TRUE(contains(of("folder"), "Is a directory")) << of("folder");
  EXPECT_TRUE(contains(of(std::string(300, 'n')), "File name too long; choose a shorter name"));
}

TEST(AtomicFile, ALibraryWritesUnderATemporaryName) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.nii";
  fs::path seen;
  write_atomically(path, ".nii", [&](const fs::path& temporary) {
    seen = temporary;
    std::ofstream(temporary) << "text";
  });
  EXPECT_EQ(seen.extension(), ".nii");
  EXPECT_EQ(slurp(path), "text");
  const auto message = failure([&] {
    write_atomically(path, ".nii", [&](const fs::path& temporary) {
      std::ofstream(temporary) << "half";
      throw SolverError("cut off");
    });
  });
  EXPECT_EQ(message, "cut off");
  EXPECT_EQ(slurp(path), "text");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(Append, AddsAWholeLineOrNone) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.csv";
  EXPECT_TRUE(contains(failure([&] { append(path, "1\n"); }), "No such file"))
      << "a file that is gone is not begun anew";
  write_atomically(path, "head\n");
  append(path, "1\n");
  const FileSizeLimit limit(10);
  EXPECT_TRUE(contains(failure([&] { append(path, "123456789\n"); }), path.string() + ": File too large"));
  EXPECT_EQ(slurp(path), "head\n1\n");
}

}  // namespace
}  // namespace tunica::files
