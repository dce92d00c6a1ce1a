// The commands and their options as texts, for the scripts and pages that are made of their definitions.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tunica::app {

struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for a positional argument
  std::string value;               ///< what stands for its value, "FILE"; empty for a flag
  std::string help;
  bool required = false;
};

struct CommandText {
  std::string name, help, footer;
  std::vector<OptionText> options;  ///< those of its groups among them
};

/// Of all subcommands, in the order in which they were added.
std::vector<CommandText> command_texts(const CLI::App& app);

}  // namespace tunica::app
