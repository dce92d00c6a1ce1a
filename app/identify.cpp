// tunica identify: values of some keys of a case, found from what was measured.
#include "tunica/pipeline/identify.hpp"

#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "exit_codes.hpp"
#include "session.hpp"
#include "version.hpp"

namespace tunica::app {

void add_identify(CLI::App& app) {
  CLI::App* command = app.add_subcommand("identify", "Stiffnesses and other values of a case, from what was measured");
  const auto request = std::make_shared<pipeline::IdentifyRequest>();
  const auto output = std::make_shared<std::string>();
  command->add_option("file", request->file, "The file of the identification")->required();
  command->add_option("-o,--output", *output, "Folder of the results, instead of the one that the file names")
      ->check(some_name());
  command->add_flag("--dry-run", request->dry_run, "Check everything and say how many runs are to be expected");
  command->footer(
      "Examples:\n"
      "  mpirun -n 2 tunica identify identify.yaml\n"
      "  tunica identify identify.yaml --dry-run\n"
      "A file of an identification:\n"
      "  case: case.yaml             # with the sections `post` and `measured`\n"
      "  parameters:\n"
      "    support: {keys: boundary.wall_outer.support.stiffness, between: [1e6 N/m^3, 1e8 N/m^3]}\n"
      "    flap: {keys: wall.regions.flap.material.neo_hooke.young_modulus, between: [0.1 MPa, 4 MPa], start: 0.5 "
      "MPa}\n"
      "    wall: {factor_on: [wall.material.dfd.shear_modulus, wall.material.dfd.k1], between: [0.3, 3]}\n"
      "  measurements: ['areas/*', 'displacements/flap']\n"
      "Results: identify.csv, identify.json, identify.html, identified.yaml (the case with the values found) and a\n"
      "folder for each run. What is there is reused, and what was interrupted goes on. Exit code 3 when the first run\n"
      "failed, or the values have not converged. All keys: tunica schema --identify");
  command->callback([=] {
    throw CLI::RuntimeError(in_session([&] {
      if (!output->empty()) request->output = *output;
      request->program = {version(), commit()};
      const auto outcome = pipeline::identify(*request, MPI_COMM_WORLD, stdout);
      if (outcome.signal != 0) return 128 + outcome.signal;
      return outcome.converged ? 0 : solver_failure;
    }));
  });
}

}  // namespace tunica::app
