// Command line of tunica. Exit codes: 0 done, 2 the input is wrong, 3 a computation failed; `tunica run`
// adds 128 + number of the signal that stopped it.
#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string>
#include <vector>

#include "commands.hpp"
#include "exit_codes.hpp"
#include "output.hpp"
#include "tunica/base/error.hpp"
#include "tunica/config/nearest.hpp"
#include "tunica/parallel/launcher.hpp"
#include "version.hpp"

namespace {

using tunica::app::input_error, tunica::app::solver_failure;

int fail(int code, const char* error) {
  std::fprintf(stderr, "tunica: %s\n", error);
  return code;
}

/// A reader of the output that goes away (`tunica run case.yaml | head`) does not end the computation, and neither do
/// standard streams that were closed before the start: without a stand-in, the first files that are opened would take
/// their numbers, and messages would be written into results.
void hold_on_to_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  for (int stream = 0; stream <= 2; ++stream)
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) return;
}

/// A first argument that is neither a command nor an option: with the command that it most likely meant.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  const std::string meant = tunica::config::nearest(argv[1], names);
  throw tunica::InputError(
      argv[1], "is no command of tunica",
      meant.empty() ? "see `tunica --help` for all commands" : "did you mean `tunica " + meant + "`?");
}

/// These work on one process: of several that mpirun has started the first one does it, and the others leave.
bool is_left_to_the_first(int argc, char** argv) {
  constexpr const char* serial[] = {"completion", "fit",  "import", "manual", "material", "mesh",
                                    "picture",    "plot", "schema", "vary",   "verify"};
  const bool alone =
      argc > 1 && std::find(std::begin(serial), std::end(serial), std::string(argv[1])) != std::end(serial);
  const long rank = alone ? tunica::parallel::rank_from_launcher() : 0;
  if (rank == 1)
    std::fprintf(stderr, "tunica %s works on one process: the others that mpirun has started leave it to the first\n",
                 argv[1]);
  return rank > 0;
}

int run(int argc, char** argv) {
  CLI::App app("Fluid-structure interaction in aortic dissection.", "tunica");
  app.set_version_flag("--version", tunica::app::version_text);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 2 the input is wrong, 3 a computation failed.\n"
      "More about a subcommand: tunica <subcommand> --help");
  tunica::app::add_check(app);
  tunica::app::add_compare(app);
  tunica::app::add_completion(app);
  tunica::app::add_converge(app);
  tunica::app::add_export(app);
  tunica::app::add_fibres(app);
  tunica::app::add_fit(app);
  tunica::app::add_follow_up(app);
  tunica::app::add_synthesise(app);
  tunica::app::add_identify(app);
  tunica::app::add_import(app);
  tunica::app::add_manual(app);
  tunica::app::add_material(app);
  tunica::app::add_measure(app);
  tunica::app::add_mesh(app);
  tunica::app::add_motion(app);
  tunica::app::add_picture(app);
  tunica::app::add_plot(app);
  tunica::app::add_post(app);
  tunica::app::add_prestress(app);
  tunica::app::add_report(app);
  tunica::app::add_run(app);
  tunica::app::add_schema(app);
  tunica::app::add_study(app);
  tunica::app::add_tune(app);
  tunica::app::add_validate(app);
  tunica::app::add_vary(app);
  tunica::app::add_verify(app);
  tunica::app::add_view(app);
  tunica::app::add_what_if(app);
  tunica::app::add_quiet(app);
  try {
    refuse_unknown_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& error) {  // how a subcommand returns another exit code
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : input_error;
  } catch (const tunica::InputError& error) {
    return fail(input_error, error.what());
  } catch (const std::exception& error) {
    return fail(solver_failure, error.what());
  } catch (...) {
    return fail(solver_failure, "unknown error");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (is_left_to_the_first(argc, argv)) return 0;
  hold_on_to_streams();
  tunica::app::let_writes_beyond_limits_fail();
  return tunica::app::with_standard_output(run(argc, argv));
}
