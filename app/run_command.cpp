// tunica run: computes a case.
#include <mpi.h>

#include <cstdio>
#include <memory>

#include "commands.hpp"
#include "import.hpp"
#include "session.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/text.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/signals.hpp"
#include "tunica/pipeline/chain.hpp"
#include "tunica/stages/run/run.hpp"
#include "version.hpp"

namespace tunica::app {
namespace {

int run(const stages::RunRequest& request) {
  const parallel::StopSignals signals;  // one that comes while the run is prepared ends it before the first step
  const stages::RunOutcome outcome = stages::run(MPI_COMM_WORLD, request, stdout);
  return outcome.signal == 0 ? 0 : 128 + outcome.signal;
}

struct Options {
  stages::RunRequest request;
  std::string case_file, directory, restart_file, until, from, units;
  bool dry_run = false;
};

/// Options that belong to the other kind of case.
void refuse(bool given, const char* option, const char* what, const char* remedy) {
  if (given) throw InputError(option, what, remedy);
}

/// A case with stages before and after its run.
int run_stages(const Options& o) {
  refuse(!o.restart_file.empty(), "--restart", "names a checkpoint, but the case has several stages",
         "leave out the file: an interrupted stage continues by itself");
  pipeline::ChainRequest request{.case_file = o.request.case_file, .directory = o.request.directory};
  if (!o.until.empty()) request.until = o.until;
  if (!o.from.empty()) request.from = o.from;
  request.overwrite = o.request.overwrite;
  request.dry_run = o.dry_run;
  request.verbose = o.request.verbose;
  request.program = o.request.program;
  const int signal = pipeline::run_chain(request, MPI_COMM_WORLD, stdout);
  return signal == 0 ? 0 : 128 + signal;
}

int run_alone(Options& o) {
  const char* remedy = "leave it out; it is for a case with sections of other stages";
  refuse(!o.from.empty(), "--from", "is given, but the case has one stage only", remedy);
  refuse(o.dry_run, "--dry-run", "is given, but the case has one stage only", remedy);
  if (!o.until.empty()) {
    const bool digits = o.until.find_first_not_of("0123456789") == std::string::npos && o.until.size() < 18;
    refuse(!digits || std::stoll(o.until) == 0, "--until", "is no number of steps, and the case has one stage only",
           "give a whole number of steps");
    o.request.until = std::stoll(o.until);
  }
  return run(o.request);
}

/// An input file of svMultiPhysics or svFSI becomes a case file in the present folder first.
void import_first(Options& o) {
  const std::filesystem::path file = o.case_file;
  const std::string ending = text::lower(file.extension().string());
  const bool other = ending == ".xml" || ending == ".inp";
  if (!other && o.units.empty()) return;
  refuse(ending == ".yaml" || ending == ".yml", "--units", "is given, but a case file says its units itself",
         "leave it out");
  const auto stem = file.has_filename() ? file.stem() : file.parent_path().stem();
  o.request.case_file = stem.string() + ".yaml";
  parallel::on_root(MPI_COMM_WORLD, [&] {
    import_and_report(
        {.file = file, .case_file = o.request.case_file, .units = o.units, .overwrite = o.request.overwrite});
  });
}

int run_either(Options& o) {
  import_first(o);
  return pipeline::is_chain(o.request.case_file, MPI_COMM_WORLD) ? run_stages(o) : run_alone(o);
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Compute a case, with all its stages");
  command->footer(
      "Examples:\n"
      "  tunica run case.yaml\n"
      "  mpirun -n 4 tunica run case.yaml\n"
      "  mpirun -n 8 tunica run case.yaml --restart          from the last checkpoint, on any number of ranks\n"
      "  tunica run case.yaml --restart results/checkpoints/step_00000200.checkpoint\n"
      "  tunica run case.yaml --output trial --until 10      ten steps, into the folder `trial`\n"
      "  tunica run solver.xml --units cgs                   as tunica import -o solver.yaml, then run solver.yaml\n"
      "Every section of the case is done. One with the sections mesh, fibres, prestress, outlets, post, report is a\n"
      "chain of stages, each in a folder of its own; the laws of `compare` come last. A stage whose inputs are "
      "unchanged\nis reused, an interrupted one continues:\n"
      "  tunica run case.yaml --dry-run                      what would be done, and why\n"
      "  tunica run case.yaml --until prestress              no further than that stage\n"
      "  tunica run case.yaml --from fibres                  that stage and all after it anew\n"
      "Results: results.xdmf for ParaView, fields (.hdf), histories (.csv), checkpoints, manifest.json, run.log.\n"
      "Ctrl-C, SIGTERM, SIGUSR1 and SIGHUP (a terminal that is closed; not under nohup) end the run after the present\n"
      "time step with a checkpoint, and so does an error. A reader of the output that goes away does not end it.\n"
      "mpirun leaves a second for that, `mpirun --mca odls_base_sigkill_timeout 10 ...` ten, and as long as it takes "
      "when mpirun gets\n"
      "SIGUSR1.\n"
      "Exit codes: 0 done, 2 the input is wrong, 3 the computation failed, 128 + number of the signal that stopped "
      "it.");
  const auto options = std::make_shared<Options>();
  command->add_option("case", options->case_file, "The case file")->required();
  auto* directory =
      command->add_option("-o,--output", options->directory, "Folder of the results, instead of the case's")
          ->check(some_name());
  auto* restart = command
                      ->add_option("--restart", options->restart_file,
                                   "Go on from the last checkpoint in the folder of results, or from FILE")
                      ->expected(0, 1)
                      ->type_name("[FILE]");
  auto* overwrite = command->add_flag("--overwrite", options->request.overwrite,
                                      "Remove earlier results in the folder first; otherwise they stop the run");
  overwrite->excludes(restart);
  command->add_option("--until", options->until, "Stop when so many steps are completed, or after this stage")
      ->type_name("STEP|STAGE");
  command->add_option("--from", options->from, "Do this stage and all after it anew")
      ->type_name("STAGE")
      ->excludes(overwrite);
  command
      ->add_option("--units", options->units,
                   "Units of a solver.xml or .inp file, as for tunica import: cgs, mmgs or si")
      ->type_name("SYSTEM");
  command->add_flag("-v,--verbose", options->request.verbose,
                    "A line for each time step on the terminal, and what else run.log holds");
  command->add_flag("--dry-run", options->dry_run, "Print which stage would be done, and why");
  command->callback([=] {
    stages::RunRequest& request = options->request;
    request.case_file = options->case_file;
    if (directory->count() > 0) request.directory = options->directory;
    request.restart = restart->count() > 0;
    if (!options->restart_file.empty()) request.restart_file = options->restart_file;
    request.program = {version(), commit()};
    throw CLI::RuntimeError(in_session([&] { return run_either(*options); }));
  });
}

}  // namespace tunica::app
