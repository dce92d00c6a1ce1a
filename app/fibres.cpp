// tunica fibres: material directions in the wall of a mesh.
#include "tunica/stages/fibres/fibres.hpp"

#include <mpi.h>

#include <cstdio>
#include <optional>

#include "commands.hpp"
#include "file_command.hpp"
#include "session.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/pipeline/chain.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

void fibres(stages::fibres::FibresRequest request) {
  const bool speaks = parallel::rank(MPI_COMM_WORLD) == 0;
  const auto say = [speaks](const std::string& line) {
    if (!speaks) return;
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  std::optional<pipeline::OwnRecord> record;  // of rank 0
  parallel::on_root(MPI_COMM_WORLD, [&] {
    const auto output = request.output.value_or(case_file::read_fibres_case(request.file).value.output);
    record.emplace("fibres", request.file, output, parallel::size(MPI_COMM_WORLD),
                   artifacts::ProgramVersion{version(), commit()});
  });
  request.before_work = [&] { record->begin(); };
  const auto report = stages::fibres::fibres_to_files(request, MPI_COMM_WORLD, say);
  if (record) record->done();
  say("\n" + report);
}

}  // namespace

void add_fibres(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fibres", "Material directions in the wall, for a case file to run on");
  command->footer(
      "Examples:\n  tunica fibres fibres.yaml\n  mpirun -n 2 tunica fibres fibres.yaml\n"
      "Writes wall/ (with e1, e2, e3, m4, m6, jump, confidence in every element), lumen/, meshes.yaml (what goes into "
      "the\ncase file) and report.json. Reference of the file: tunica schema --fibres");
  add_file_arguments(*command,
                     {.file = "The mesh, its faces, the angles of the fibres",
                      .output = "Folder of the result, instead of the one that the file names",
                      .overwrite = "Replace a result that is there"},
                     [](const FileRequest& given) {
                       stages::fibres::FibresRequest request{.file = given.file, .overwrite = given.overwrite};
                       if (!given.output.empty()) request.output = given.output;
                       throw CLI::RuntimeError(in_session([&] { return fibres(request), 0; }));
                     });
}

}  // namespace tunica::app
