// tunica report: one page with what the stages of a case have done and found.
#include "tunica/stages/report/report.hpp"

#include <mpi.h>

#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "tunica/base/error.hpp"
#include "tunica/pipeline/chain.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

/// The page of a case file: its stage `report` alone, on what the others have left.
int report_of_case(const FileRequest& request) {
  if (!pipeline::is_chain(request.file, MPI_COMM_WORLD))
    throw InputError(request.file, "is a case of a run alone, which has no page",
                     "add `report: {}` to it and use `tunica run`; or give a file as `tunica schema --report` has it");
  if (!request.output.empty())
    throw InputError("--output", "is given, but the page of a case lies in its folder of results", "leave it out");
  pipeline::ChainRequest chain{.case_file = request.file};
  chain.only = "report";
  chain.overwrite = request.overwrite;
  chain.program = {version(), commit()};
  return pipeline::run_chain(chain, MPI_COMM_WORLD, stdout);
}

int report(const FileRequest& request) {
  if (pipeline::is_case(request.file, MPI_COMM_WORLD)) return report_of_case(request);
  auto parsed = stages::read_report_case(request.file);
  print_warnings(parsed.warnings);
  if (!request.output.empty()) parsed.value.output = request.output;
  const auto say = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  const auto page = stages::report_to_file(parsed.value, {version(), commit()}, request.overwrite, say);
  std::printf("written: %s\n", page.c_str());
  return 0;
}

}  // namespace

void add_report(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "One page with what the stages of a case have done and found");
  command->footer(
      "Examples:\n  tunica report case.yaml\n  tunica report report.yaml\n  xvfb-run -a tunica report report.yaml "
      "--overwrite      with pictures "
      "where there is no screen\n"
      "`tunica run` writes such a file, and the page, for a case with the section `report`.\n"
      "Reference of the file: tunica schema --report");
  add_file_arguments(
      *command,
      {.file = "The case file, or a file with the folders of the stages and what the page shall hold",
       .output = "Folder of the page, instead of the one that the file names",
       .overwrite = "Replace a page that is there"},
      [](const FileRequest& request) { throw CLI::RuntimeError(in_session([&] { return report(request); })); });
}

}  // namespace tunica::app
