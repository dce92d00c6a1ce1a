// tunica validate: benchmarks beside their references.
#include "tunica/stages/validate/validate.hpp"

#include <memory>

#include "commands.hpp"
#include "session.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/stages/meshing/mesh_case.hpp"
#include "tunica/stages/run/run.hpp"
#include "version.hpp"

namespace tunica::app {

void add_validate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("validate", "Compute benchmarks and hold them against their references");
  command->footer(
      "Examples:\n"
      "  tunica validate --list\n"
      "  tunica validate                                      all that take seconds or minutes, on coarse meshes\n"
      "  mpirun -n 2 tunica validate turek_hron_fsi1 --full   one of them, on a mesh that resolves it\n"
      "Each is a case in a folder of its own, which `tunica run` takes as well. Results whose case is unchanged are\n"
      "used again, an interrupted run goes on. validation.html, .csv and .json have every figure beside its "
      "reference.\n"
      "Exit codes: 0 all passed, 2 the input is wrong, 3 a figure was missed or a computation failed, 128 + number of\n"
      "the signal that stopped it.");
  const auto request = std::make_shared<stages::ValidateRequest>();
  const auto folder = std::make_shared<std::string>("validation"),
             elements = std::make_shared<std::string>("quadratic");
  command->add_option("names", request->names, "Benchmarks; all that do not take long when left out");
  const auto list = std::make_shared<bool>(false);
  command->add_flag("--list", *list, "Print the names and stop");
  command->add_flag("--full", request->full, "On meshes and for times that resolve them");
  command->add_option("--elements", *elements, "linear or quadratic")
      ->check(CLI::IsMember({"linear", "quadratic"}))
      ->capture_default_str();
  command->add_option("-o,--output", *folder, "Folder of cases and results")->capture_default_str()->check(some_name());
  command->callback([=] {
    if (*list) {
      std::fputs(stages::list_benchmarks().c_str(), stdout);
      return;
    }
    request->folder = *folder;
    request->elements = *elements == "linear" ? case_file::Elements::linear : case_file::Elements::quadratic;
    request->run_case = [](const auto&... arguments) {
      const parallel::StopSignals signals;
      return stages::run_case(arguments...);
    };
    request->program = {version(), commit()};
    request->make_mesh = [](const std::filesystem::path& file) {
      const auto parsed = case_file::read_mesh_case(file);
      stages::mesh_to_files(parsed.value, true, [](const std::string&) {});
    };
    throw CLI::RuntimeError(in_session([&] {
      const auto outcome = stages::validate_program(MPI_COMM_WORLD, *request, stdout);
      return outcome.signal != 0 ? 128 + outcome.signal : outcome.passed ? 0 : 3;
    }));
  });
}

}  // namespace tunica::app
