// tunica report: one page with what the stages of a case have done and found.
#include "tunica/stages/report/report.hpp"

#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

void report(const FileRequest& request) {
  auto parsed = stages::read_report_case(request.file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto say = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  const auto page = stages::report_to_file(parsed.value, {version(), commit()}, request.overwrite, say);
  std::printf("written: %s\n", page.c_str());
}

}  // namespace

void add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "One page with what the stages of a case have done and found");
  command->footer(
      "Examples:\n  tunica report report.yaml\n  xvfb-run -a tunica report report.yaml --overwrite      with pictures "
      "where there is no screen\n"
      "`tunica run` writes such a file, and the page, for a case with the section `report`.\n"
      "Reference of the file: tunica schema --report");
  add_file_arguments(*command,
                     {.file = "Folders of the stages, and what the page shall hold",
                      .output = "Folder of the page, instead of the one that the file names",
                      .overwrite = "Replace a page that is there"},
                     report);
}

}  // namespace tunica::app
