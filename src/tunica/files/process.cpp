#include "tunica/files/process.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace tunica::files {

namespace {

std::string first_line(const char* file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

struct Stat {
  char state;
  std::uint64_t start;
};

/// From /proc/<pid>/stat: "pid (command) state ...", where the command may hold blanks and brackets.
std::optional<Stat> stat_of(std::int64_t pid) {
  std::ifstream stream(fmt::format("/proc/{}/stat", pid));
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto end = text.rfind(')');
  if (end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(end + 1));
  Stat stat{};
  fields >> stat.state;
  std::string skipped;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  fields >> stat.start;
  if (!fields) return std::nullopt;
  return stat;
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace

ProcessId this_process() {
  ProcessId id;
  id.host = host_name();
  id.machine = first_line("/etc/machine-id");
  id.boot = first_line("/proc/sys/kernel/random/boot_id");
  std::error_code none;
  id.space = std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
  id.pid = getpid();
  if (const auto stat = stat_of(id.pid)) id.start = stat->start;
  return id;
}

std::string command_of_this_process() {
  std::ifstream stream("/proc/self/cmdline");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  while (!text.empty() && text.back() == '\0') text.pop_back();
  for (char& c : text)
    if (c == '\0' || c == '\n') c = ' ';
  return text;
}

Fate fate(const ProcessId& process) {
  const ProcessId here = this_process();
  if (process.host != here.host || process.machine != here.machine) return Fate::unknown;
  if (process.boot.empty() || here.boot.empty() || here.start == 0) return Fate::unknown;
  if (process.boot != here.boot) return Fate::ended;  // the machine was started anew
  if (process.space != here.space) return Fate::unknown;
  const auto stat = stat_of(process.pid);
  // /proc may hide processes of other users, to which no signal may be sent either.
  if (!stat) return kill(static_cast<pid_t>(process.pid), 0) == 0 || errno == EPERM ? Fate::unknown : Fate::ended;
  // A zombie has ended, and only waits to be asked for its exit code.
  const bool runs = stat->start == process.start && stat->state != 'Z' && stat->state != 'X';
  return runs ? Fate::runs : Fate::ended;
}

}  // namespace tunica::files
