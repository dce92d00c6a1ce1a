// tunica check: is a case file sound?
#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/stages/run/run.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

void print(const std::vector<std::string>& lines, const char* before = "") {
  for (const auto& line : lines) std::printf("%s%s\n", before, line.c_str());
}

void check(const std::filesystem::path& file) {
  const bool speaks = parallel::rank(MPI_COMM_WORLD) == 0;
  if (pipeline::is_chain(file, MPI_COMM_WORLD)) {
    parallel::on_root(MPI_COMM_WORLD, [&] {
      print(pipeline::check_chain({.case_file = file, .program = {version(), commit()}}, true));
      std::printf("%s: no errors that can be found before its stages are done\n", file.c_str());
    });
    return;
  }
  const auto found = stages::check_run(MPI_COMM_WORLD, file);
  if (!speaks) return;
  print(found.report);
  print(found.warnings, "warning: ");
  const std::size_t warnings = found.warnings.size();
  std::printf("%s: no errors, %zu warning%s\n", file.c_str(), warnings, warnings == 1 ? "" : "s");
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "check", "Validate a case file, all files that it names and what it poses, without running it");
  command->footer(
      "Example:\n  tunica check case.yaml\nReports all errors at once (exit code 2), and warns of values that look "
      "like slips.");
  const auto file = std::make_shared<std::string>();
  command->add_option("case", *file, "The case file")->required();
  command->callback([file] { throw CLI::RuntimeError(in_session([&] { return check(*file), 0; })); });
}

}  // namespace tunica::app
