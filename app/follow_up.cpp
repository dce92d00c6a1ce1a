// tunica follow-up: scans of one patient over the years, and what was computed on them.
#include "tunica/pipeline/follow_up.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {

void add_follow_up(CLI::App& app) {
  CLI::App* command = app.add_subcommand("follow-up", "Scans of one patient over the years: growth, and what drove it");
  const auto request = std::make_shared<pipeline::FollowUpRequest>();
  const auto output = std::make_shared<std::string>();
  command->add_option("file", request->file, "The file of the scans")->required();
  command->add_option("-o,--output", *output, "Folder of the results, instead of the one that the file names")
      ->check(some_name());
  command->add_flag("--run", request->run, "Compute the beat of every scan, and hold growth beside it");
  command->add_flag("--dry-run", request->dry_run, "Write the case files of the scans and say what would be done");
  command->footer(
      "Examples:\n"
      "  tunica follow-up scans.yaml                   meshes, growth, maps between the dates\n"
      "  mpirun -n 2 tunica follow-up scans.yaml --run stress, wall shear and pressure beside the growth\n"
      "A file of scans:\n"
      "  case: case.yaml               # its `mesh` says how all scans are meshed\n"
      "  scans:\n"
      "    baseline: {date: 2021-03-04, geometry: {image: {file: 2021.nii.gz, ...}}}\n"
      "    year_1:   {date: 2022-03-11, geometry: {image: {file: 2022.nii.gz, ...}}}\n"
      "    year_3:   {date: 2024-02-28, case: 2024/case.yaml}\n"
      "Results: follow_up.html, follow_up.json, tables (.csv), growth.vtp and maps (.vtp) for ParaView, a folder for\n"
      "each scan. What is there is reused. All keys: tunica schema --follow-up");
  command->callback([=] {
    throw CLI::RuntimeError(in_session([&] {
      if (!output->empty()) request->output = *output;
      request->program = {version(), commit()};
      const int signal = pipeline::follow_up(*request, MPI_COMM_WORLD, stdout);
      return signal == 0 ? 0 : 128 + signal;
    }));
  });
}

}  // namespace tunica::app
