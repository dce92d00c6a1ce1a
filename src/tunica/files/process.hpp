// Who a process is, so that another one can tell later whether it still runs.
#pragma once

#include <cstdint>
#include <string>

namespace tunica::files {

/// A process number alone does not do: it is used again, on every host and in every container.
struct ProcessId {
  std::string host;
  std::string machine;  ///< /etc/machine-id, empty where there is none
  std::string boot;     ///< changes when the machine starts
  std::string space;    ///< in which the number counts: containers have their own
  std::int64_t pid = 0;
  std::uint64_t start = 0;  ///< ticks after the boot

  bool operator==(const ProcessId&) const = default;
};

ProcessId this_process();

/// Its command line, arguments separated by blanks.
std::string command_of_this_process();

enum class Fate { runs, ended, unknown };
/// Seen from this process. Unknown: it is one of another host or container.
Fate fate(const ProcessId& process);

}  // namespace tunica::files
