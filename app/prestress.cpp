// tunica prestress: what an imaged wall carries in the shape in which it was imaged.
#include "tunica/stages/prestress/prestress.hpp"

#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/parallel/signals.hpp"
#include "version.hpp"

namespace tunica::app {

void add_prestress(CLI::App& app) {
  CLI::App* command = app.add_subcommand("prestress", "Find the prestress of the imaged wall under its diastolic load");
  command->footer(
      "Examples:\n"
      "  mpirun -n 4 tunica prestress case.yaml\n"
      "  tunica prestress case.yaml --keep-flow              the fixed point anew, with the steady flow that is "
      "there;\n"
      "                                                      a steady flow that was interrupted goes on\n"
      "The section `prestress` of the case says how. Then name the results in the case, and run it:\n"
      "  wall: {prestress: prestress/wall.vtu}\n"
      "  start: prestress/start.checkpoint\n"
      "Exit codes: 0 done, 2 the input is wrong, 3 the computation failed, 128 + number of the signal that stopped "
      "it.");
  const auto request = std::make_shared<stages::PrestressRequest>();
  const auto case_file = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
  command->add_option("case", *case_file, "The case file")->required();
  auto* given = command->add_option("-o,--output", *directory, "Folder of the results, instead of the case's")
                    ->check(some_name());
  auto* keep = command->add_flag("--keep-flow", request->keep_flow, "Take the steady flow that is in the folder");
  command->add_flag("--overwrite", request->overwrite, "Replace what is there")->excludes(keep);
  command->add_flag("-v,--verbose", request->verbose, "On the terminal what else prestress.log holds");
  command->callback([=] {
    request->case_file = *case_file;
    if (given->count() > 0) request->directory = *directory;
    request->program = {version(), commit()};
    throw CLI::RuntimeError(in_session([&] {
      const parallel::StopSignals signals;
      const int signal = stages::prestress(MPI_COMM_WORLD, *request, stdout);
      return signal == 0 ? 0 : 128 + signal;
    }));
  });
}

}  // namespace tunica::app
