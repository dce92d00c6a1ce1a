#include "tunica/files/lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <fstream>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/outputs.hpp"
#include "tunica/files/process.hpp"
#include "tunica/files/time_stamp.hpp"

namespace tunica::files {

namespace fs = std::filesystem;

namespace {

constexpr auto pause_between_trials = std::chrono::milliseconds(10);
constexpr int most_trials = 500;            // where others take the folder over at the same time
constexpr int most_unreadable_trials = 50;  // one that is just being written without hard links
/// Each level is a process that ended within the microseconds in which it took a lock over.
constexpr int deepest_takeover = 8;

struct Owner {
  ProcessId process;
  std::string command, since;
  std::string text;  ///< of the file
};

std::string text_of(const ProcessId& id) {
  return fmt::format(
      "# tunica: this folder is being written by one process, which removes this file when it ends.\n"
      "host: {}\npid: {}\nstart: {}\nboot: {}\nmachine: {}\nprocess_space: {}\ncommand: {}\nsince: {}\n",
      id.host, id.pid, id.start, id.boot, id.machine, id.space, command_of_this_process(), time_stamp());
}

template <class Number>
bool read_number(const std::string& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::optional<Owner> parse(const std::string& text) {
  std::map<std::string, std::string> values;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = text.find('\n', begin);
    if (end == std::string::npos) return std::nullopt;  // cut off
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (const auto colon = line.find(": "); colon != std::string::npos)
      values.emplace(line.substr(0, colon), line.substr(colon + 2));
  }
  Owner owner{.process = {}, .command = values["command"], .since = values["since"], .text = text};
  ProcessId& p = owner.process;
  p.host = values["host"], p.boot = values["boot"], p.machine = values["machine"], p.space = values["process_space"];
  if (p.host.empty() || owner.since.empty() || !read_number(values["pid"], p.pid) ||
      !read_number(values["start"], p.start))
    return std::nullopt;
  return owner;
}

enum class OwnerReading { missing, unreadable, done };

OwnerReading read_owner(const fs::path& lock, Owner& owner) {
  refuse_other_than_file(lock);
  std::ifstream stream(lock);
  std::error_code ignored;
  if (!stream) return fs::exists(fs::symlink_status(lock, ignored)) ? OwnerReading::unreadable : OwnerReading::missing;
  const auto parsed = parse({std::istreambuf_iterator<char>(stream), {}});
  if (!parsed) return OwnerReading::unreadable;
  owner = *parsed;
  return OwnerReading::done;
}

std::string description(const Owner& owner) {
  return fmt::format("`{}` (process {} on {}, since {})", owner.command, owner.process.pid, owner.process.host,
                     owner.since);
}

std::string folder_of(const fs::path& lock) {
  return lock.has_parent_path() ? lock.parent_path().string() : fs::current_path().string();
}

[[noreturn]] void refuse(const fs::path& lock, const Owner& owner) {
  const bool runs = fate(owner.process) == Fate::runs;
  throw InputError(folder_of(lock),
                   fmt::format("is being written by {}{}", description(owner),
                               runs ? "" : "; from here it cannot be told whether that process still runs"),
                   fmt::format("wait for its end, or choose another folder{}",
                               runs ? "" : fmt::format("; if it is known to have ended, remove {}", lock.string())));
}

[[noreturn]] void refuse_unreadable(const fs::path& lock) {
  throw InputError(lock.string(), "does not say who owns the folder",
                   "remove this file if no process writes into the folder");
}

[[noreturn]] void cannot_lock(const fs::path& lock, int error) {
  throw InputError(folder_of(lock), "nothing can be written here: " + write_failure(error),
                   "name a folder that can be written");
}

/// The lock under a name of its own, to be linked or renamed to the name of all.
class Draft {
 public:
  Draft(const fs::path& lock, const ProcessId& id) {
    file_ = fmt::format("{}.{}.{}.draft", lock.string(), id.host, id.pid);
    std::error_code ignored;
    fs::remove(file_, ignored);  // of a process that had the same number
    const std::string text = text_of(id);
    const int descriptor = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) cannot_lock(lock, errno);
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    int error = written < 0 ? errno : written < std::ssize(text) ? ENOSPC : 0;
    if (error == 0 && fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) error = errno;
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) return;
    unlink(file_.c_str());
    cannot_lock(lock, error);
  }
  ~Draft() { unlink(file_.c_str()); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  /// False when there is a file of that name already.
  bool link_to(const fs::path& lock) const {
    if (link(file_.c_str(), lock.c_str()) == 0) return true;
    const int error = errno;
    struct stat draft {};  // over a network the answer may be lost, and the link be there nevertheless
    if (stat(file_.c_str(), &draft) == 0 && draft.st_nlink == 2) return true;
    if (error == EEXIST) return false;
    if (error == EPERM || error == ENOTSUP || error == ENOSYS || error == EMLINK) return copy_to(lock);
    cannot_lock(lock, error);
  }
  void replace(const fs::path& lock) const {
    if (std::rename(file_.c_str(), lock.c_str()) != 0) cannot_lock(lock, errno);
  }

 private:
  /// File systems without hard links are local ones, where a file can be made by one process only as well.
  bool copy_to(const fs::path& lock) const {
    std::ifstream stream(file_);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const int descriptor = open(lock.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST) return false;
    if (descriptor < 0) cannot_lock(lock, errno);
    const bool written = ::write(descriptor, text.data(), text.size()) == std::ssize(text);
    const int error = errno;
    ::close(descriptor);
    if (written) return true;
    unlink(lock.c_str());
    cannot_lock(lock, error);
  }

  fs::path file_;
};

struct Acquired {
  bool nested = false;              ///< this process has it already
  std::optional<Owner> taken_from;  ///< whose process had ended
};

std::optional<Acquired> take_over(const Draft& draft, const fs::path& lock, const Owner& ended, const ProcessId& me,
                                  int depth);

/// Nothing: it is with another process at this moment, which may be about to give it back.
std::optional<Acquired> try_to_acquire(const Draft& draft, const fs::path& lock, const ProcessId& me, int depth) {
  if (draft.link_to(lock)) return Acquired{};
  Owner owner;
  if (read_owner(lock, owner) != OwnerReading::done) return std::nullopt;
  if (owner.process == me) return Acquired{.nested = true, .taken_from = {}};
  if (fate(owner.process) == Fate::ended) return take_over(draft, lock, owner, me, depth);
  if (depth == 0) refuse(lock, owner);
  return std::nullopt;
}

/// Replacing the lock of an ended process is itself the business of one process at a time, so it is done under a lock
/// of its own, and only when the lock is still the one that was looked at.
std::optional<Acquired> take_over(const Draft& draft, const fs::path& lock, const Owner& ended, const ProcessId& me,
                                  int depth) {
  if (depth == deepest_takeover) refuse_unreadable(lock);
  const fs::path inner = lock.string() + ".takeover";
  if (!try_to_acquire(Draft(inner, me), inner, me, depth + 1)) return std::nullopt;
  const struct Remove {
    ~Remove() { unlink(file.c_str()); }
    const fs::path& file;
  } at_the_end{inner};
  Owner now;
  if (read_owner(lock, now) != OwnerReading::done || now.text != ended.text) return std::nullopt;
  draft.replace(lock);
  return Acquired{.nested = false, .taken_from = ended};
}

Acquired acquire(const fs::path& lock) {
  const ProcessId me = this_process();
  const Draft draft(lock, me);
  int unreadable = 0;
  for (int trial = 0; trial < most_trials && unreadable < most_unreadable_trials; ++trial) {
    if (auto acquired = try_to_acquire(draft, lock, me, 0)) return *acquired;
    Owner owner;
    if (read_owner(lock, owner) == OwnerReading::unreadable) ++unreadable;
    std::this_thread::sleep_for(pause_between_trials);
  }
  refuse_unreadable(lock);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : holder_(getpid()) {
  std::error_code ignored;
  made_folder_ = !fs::exists(folder.empty() ? "." : folder, ignored);
  if (!folder.empty()) make_folder(folder);
  const fs::path lock = folder / lock_name;
  try {
    const Acquired acquired = acquire(lock);
    if (!acquired.nested) file_ = lock;
    if (acquired.taken_from)
      taken_over_ = fmt::format("{}: was left locked by {}, which has ended without giving it back; taken over",
                                folder.string(), description(*acquired.taken_from));
  } catch (...) {
    if (made_folder_) rmdir(folder.c_str());
    throw;
  }
}

FolderLock::~FolderLock() { release(); }

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::exchange(other.file_, {})),
      holder_(other.holder_),
      made_folder_(other.made_folder_),
      taken_over_(std::move(other.taken_over_)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  release();
  file_ = std::exchange(other.file_, {});
  holder_ = other.holder_;
  made_folder_ = other.made_folder_;
  taken_over_ = std::move(other.taken_over_);
  return *this;
}

void FolderLock::release() noexcept {
  if (file_.empty() || holder_ != getpid()) return;
  Owner owner;
  // Somebody may have removed it by hand and another process taken its place.
  if (read_owner(file_, owner) == OwnerReading::done && owner.process.pid == holder_ && owner.process == this_process())
    unlink(file_.c_str());
  if (made_folder_) rmdir(file_.parent_path().c_str());  // does nothing when there is something in it
  file_.clear();
}

void refuse_if_owned_by_another(const fs::path& folder) {
  const fs::path lock = folder / lock_name;
  Owner owner;
  if (read_owner(lock, owner) != OwnerReading::done || owner.process == this_process()) return;
  if (fate(owner.process) != Fate::ended) refuse(lock, owner);
}

}  // namespace tunica::files
