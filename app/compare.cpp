// tunica compare: the same case with several wall laws.
#include "tunica/pipeline/compare.hpp"

#include <mpi.h>

#include <cstdio>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

int compare(const FileRequest& given) {
  pipeline::ChainRequest request{.case_file = given.file};
  if (!given.output.empty()) request.directory = given.output;
  request.overwrite = given.overwrite;
  request.program = {version(), commit()};
  const int signal = pipeline::compare_laws(request, MPI_COMM_WORLD, stdout);
  return signal == 0 ? 0 : 128 + signal;
}

}  // namespace

void add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Stresses and displacements of a case with several wall laws");
  command->footer(
      "Example:\n  mpirun -n 2 tunica compare case.yaml\n"
      "The section `compare` of the case names the laws: `compare: {soft: {material: {neo_hooke: ...}}, ...}`. Mesh,\n"
      "directions and outlets are those of the case; prestress, run and figures are made for each law. Results:\n"
      "compare/compare.html, compare.csv and a folder for each law in the folder of results. Stages are reused as by\n"
      "`tunica run`.");
  add_file_arguments(
      *command,
      {.file = "The case file",
       .output = "Folder of the results, instead of the one that the case names",
       .overwrite = "Do all stages anew"},
      [](const FileRequest& given) { throw CLI::RuntimeError(in_session([&] { return compare(given); })); });
}

}  // namespace tunica::app
