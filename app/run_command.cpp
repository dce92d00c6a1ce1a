// tunica run: computes a case.
#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/stages/run.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

/// Returns the exit code.
int run(const stages::RunRequest& request) {
  return in_session([&] {
    const stages::RunOutcome outcome = stages::run(MPI_COMM_WORLD, request, stdout);
    return outcome.signal == 0 ? 0 : 128 + outcome.signal;
  });
}

struct Options {
  stages::RunRequest request;
  std::string case_file, directory, restart_file;
  std::int64_t until = 0;
};

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Compute a case");
  command->footer(
      "Examples:\n"
      "  tunica run case.yaml\n"
      "  mpirun -n 4 tunica run case.yaml\n"
      "  mpirun -n 8 tunica run case.yaml --restart          from the last checkpoint, on any number of ranks\n"
      "  tunica run case.yaml --restart results/checkpoints/step_00000200.checkpoint\n"
      "  tunica run case.yaml --output trial --until 10      ten steps, into the folder `trial`\n"
      "Results: time series for ParaView (.pvd), histories (.csv), checkpoints, manifest.json, run.log.\n"
      "Ctrl-C, SIGTERM and SIGUSR1 end the run after the present time step with a checkpoint. mpirun leaves it a\n"
      "second for that, `mpirun --mca odls_base_sigkill_timeout 10 ...` ten, and as long as it takes when mpirun gets\n"
      "SIGUSR1.\n"
      "Exit codes: 0 done, 2 the input is wrong, 3 the computation failed, 128 + number of the signal that stopped "
      "it.");
  const auto options = std::make_shared<Options>();
  command->add_option("case", options->case_file, "The case file")->required();
  auto* directory =
      command->add_option("-o,--output", options->directory, "Folder of the results, instead of the case's");
  auto* restart = command
                      ->add_option("--restart", options->restart_file,
                                   "Go on from the last checkpoint in the folder of results, or from FILE")
                      ->expected(0, 1)
                      ->type_name("[FILE]");
  auto* overwrite = command->add_flag("--overwrite", options->request.overwrite,
                                      "Remove earlier results in the folder first; otherwise they stop the run");
  overwrite->excludes(restart);
  auto* until = command->add_option("--until", options->until, "Stop when so many steps are completed")
                    ->check(CLI::PositiveNumber)
                    ->type_name("STEP");
  command->callback([=] {
    stages::RunRequest& request = options->request;
    request.case_file = options->case_file;
    if (directory->count() > 0) request.directory = options->directory;
    if (until->count() > 0) request.until = options->until;
    request.restart = restart->count() > 0;
    if (!options->restart_file.empty()) request.restart_file = options->restart_file;
    request.program = {version(), commit()};
    throw CLI::RuntimeError(run(request));
  });
}

}  // namespace tunica::app
