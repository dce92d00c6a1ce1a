// What is written must have been written: limits and full disks met by the process itself and by its standard output.
#pragma once

#include <CLI/CLI.hpp>

namespace tunica::app {

/// Beyond a limit for the size of files (`ulimit -f`) a write shall fail, with an error that names the file, and not
/// kill the process.
void let_writes_beyond_limits_fail();

/// Exit code of the program: `code`, or that of a failed computation when that is 0 and the standard output was cut
/// off, by a full disk say. A reader that has gone away (a pipe, a terminal that was closed) is no failure.
int with_standard_output(int code);

/// Gives every command that reports on its work the option --quiet: nothing on the standard output. Files, logs and
/// errors stay. Not those whose result is what they print.
void add_quiet(CLI::App& app);

}  // namespace tunica::app
