// tunica tune: outlets for given pressures and shares of the flow.
#include "tunica/stages/tuning/tune.hpp"

#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/run/run.hpp"
#include "version.hpp"

namespace tunica::app {

void add_tune(CLI::App& app) {
  CLI::App* command = app.add_subcommand("tune", "Find Windkessel outlets for given pressures and shares of the flow");
  command->footer(
      "Examples:\n"
      "  mpirun -n 4 tunica tune case.yaml\n"
      "  mpirun -n 4 tunica tune case.yaml --overwrite       anew, after the case was changed\n"
      "The section `outlets` of the case says what is asked:\n"
      "  outlets:\n"
      "    systolic: 125 mmHg\n"
      "    diastolic: 75 mmHg\n"
      "    fractions: {lumen_celiac: 0.12, lumen_left_iliac: 0.88}\n"
      "A part of a cycle and then one or two whole ones are computed in 3D. Called again, an interrupted tuning goes\n"
      "on. `tunica run case.yaml` takes the outlets from the file that this writes.\n"
      "Exit codes: 0 done, 2 the input is wrong, 3 the computation failed or the targets were missed, 128 + number of\n"
      "the signal that stopped it.");
  const auto request = std::make_shared<stages::TuneRequest>();
  const auto case_file = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
  command->add_option("case", *case_file, "The case file")->required();
  auto* given = command->add_option("-o,--output", *directory, "Folder of the results, instead of the case's")
                    ->check(some_name());
  command->add_flag("--overwrite", request->overwrite, "Replace the tuning of another case in that folder");
  command->add_flag("-v,--verbose", request->verbose, "A line for each time step on the terminal");
  command->callback([=] {
    request->case_file = *case_file;
    if (given->count() > 0) request->directory = *directory;
    request->program = {version(), commit()};
    request->run_case = stages::run_case;
    throw CLI::RuntimeError(in_session([&] {
      const parallel::StopSignals signals;
      const int signal = stages::tune(MPI_COMM_WORLD, *request, stdout);
      return signal == 0 ? 0 : 128 + signal;
    }));
  });
}

}  // namespace tunica::app
