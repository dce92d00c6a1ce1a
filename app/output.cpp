#include "output.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string>

#include "exit_codes.hpp"
#include "tunica/base/error.hpp"

namespace tunica::app {
namespace {

/// Commands whose result is their standard output.
constexpr const char* printing[] = {"completion", "manual", "schema"};

void hush() {
  std::fflush(stdout);
  if (std::freopen("/dev/null", "w", stdout) == nullptr)
    throw InputError("--quiet", std::string("/dev/null cannot be opened: ") + std::strerror(errno),
                     "send the standard output elsewhere");
}

}  // namespace

void let_writes_beyond_limits_fail() { std::signal(SIGXFSZ, SIG_IGN); }

int with_standard_output(int code) {
  const bool failed_before = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !failed_before) return code;
  // The stream keeps no cause, so a line is tried once more.
  const bool works_again = write(STDOUT_FILENO, "\n", 1) == 1;
  const int error = works_again ? 0 : errno;
  if (code != 0 || error == EPIPE || error == EIO || error == EBADF) return code;
  std::fprintf(stderr,
               "tunica: the standard output was cut off: %s; files in folders of results are complete, their writing "
               "is checked by itself. Free some space where the standard output goes\n",
               works_again ? "for a time it could not be written" : std::strerror(error));
  return solver_failure;
}

void add_quiet(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({}))
    if (std::find(std::begin(printing), std::end(printing), command->get_name()) == std::end(printing))
      command->add_flag_callback("-q,--quiet", hush, "Print nothing on the standard output; errors stay");
}

}  // namespace tunica::app
