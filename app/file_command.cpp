#include "file_command.hpp"

#include <cstdio>
#include <memory>

#include "commands.hpp"

namespace tunica::app {

void add_file_arguments(CLI::App& command, const FileCommandHelp& help,
                        const std::function<void(const FileRequest&)>& action) {
  const auto request = std::make_shared<FileRequest>();
  command.add_option("file", request->file, help.file)->required();
  command.add_option("-o,--output", request->output, help.output)->check(some_name());
  command.add_flag("--overwrite", request->overwrite, help.overwrite);
  command.callback([=] { action(*request); });
}

void print_warnings(const std::vector<Problem>& warnings) {
  for (const Problem& warning : warnings) std::printf("warning: %s\n", format(warning).c_str());
}

}  // namespace tunica::app
