// Subcommands that make something of one file: `tunica <name> FILE [--output OUTPUT] [--overwrite]`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"

namespace tunica::app {

struct FileRequest {
  std::string file, output;  ///< output is empty when it is not given
  bool overwrite = false;
};

struct FileCommandHelp {
  const char *file, *output, *overwrite;
};

/// Adds the arguments and calls `action` with them.
void add_file_arguments(CLI::App& command, const FileCommandHelp& help,
                        const std::function<void(const FileRequest&)>& action);

void print_warnings(const std::vector<Problem>& warnings);

}  // namespace tunica::app
